"""Twists that trackers make of noisy poses."""

from dataclasses import replace

import numpy as np
import pytest
from rehearsal import Surroundings, random_forces, rehearse
from scipy.signal import savgol_filter

from diffbot_sim.identification import identify
from diffbot_sim.identification.recordings.smoothing import smoothed_over
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects.slope import Slope
from diffbot_sim.records import Odometry, Run

INTERVAL = 0.02


def tracked(model: Model, half: int) -> Run:
    """Return what a tracker tells: noisy poses, and slopes of parabolas over half to each side."""
    run = rehearse(model, random_forces(2, 60.0, -9.0, 11.0), Surroundings(), 2)
    true = run.odometry.pose
    pose = true + np.random.default_rng(1).normal(size=true.shape) * [6e-4, 6e-4, 1.5e-3]
    rate = savgol_filter(pose, 2 * half + 1, 2, deriv=1, delta=INTERVAL, axis=0)
    v = rate[:, 0] * np.cos(true[:, 2]) + rate[:, 1] * np.sin(true[:, 2])
    return replace(
        run, odometry=Odometry(run.odometry.time, np.column_stack([v, rate[:, 2]]), pose)
    )


@pytest.mark.parametrize('half', [4, 6, 10])
def test_noise_tells_over_how_many_samples_a_twist_was_smoothed(half: int) -> None:
    seen = tracked(Model(), half).odometry
    moved = np.diff(seen.pose[:, 2]) / INTERVAL
    assert smoothed_over(moved, seen.twist[1:, 1]) == pytest.approx(half, abs=1)


def test_twist_with_noise_of_its_own_was_not_made_of_the_pose() -> None:
    noise = np.random.default_rng(1).normal(size=(2, 3000))
    rate = np.sin(np.arange(3000) / 70.0)
    assert smoothed_over(rate + noise[0], rate + 0.01 * noise[1]) == 0


def test_pose_integrated_from_the_twist_is_no_source_of_it() -> None:
    rate = np.random.default_rng(1).normal(size=3000)
    assert smoothed_over(0.5 * (rate[1:] + rate[:-1]), rate[1:]) == 0


def test_smoothed_twists_make_no_robot_strange() -> None:
    answer = identify([tracked(Model(), 4)], Model())
    assert answer.verdict == 'nothing_missing'
    assert [timing.taken for timing in answer.timings] == ['smoothed']


def test_effect_is_found_behind_smoothed_twists() -> None:
    (effect,) = identify([tracked(Model(effects=(Slope(0.02, 0.01),)), 4)], Model()).effects
    assert effect.name == 'slope'
    assert effect.parameters['grade_x'].value == pytest.approx(0.02, rel=0.1)
