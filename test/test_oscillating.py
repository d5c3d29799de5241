"""Forces that come and go at a rate of their own, told from rough floors."""

from dataclasses import replace

import numpy as np
import pytest
from fits import ROUGH, SMOOTH, acted_otherwise, fitted
from rehearsal import Surroundings, random_forces

from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.free_forms.oscillating import find_line, oscillating
from diffbot_sim.records import Array

DRIVE = random_forces(5, 90.0, 2.0, 14.0)
AWAY = np.array([1.0, 1.0])


def fit_with(
    amplitude: float, wheels: Array = AWAY, around: Surroundings = SMOOTH, seconds: float = 90.0
) -> Fit:
    """Return a plain fit where a drum of 1.3 Hz shakes the wheels, out of step each 7 s."""
    drive = random_forces(5, seconds, 2.0, 14.0)
    phase = 2.0 * np.pi * 1.3 * drive.time + 2.0 * np.floor(drive.time / 7.0) ** 2
    force = drive.force + amplitude * np.sin(phase)[:, None] * wheels
    fit, _ = fitted(acted_otherwise(drive, force, around, 5))
    return fit


@pytest.mark.parametrize('around', [SMOOTH, ROUGH])
def test_drum_that_keeps_no_step_is_told_with_its_rate(around: Surroundings) -> None:
    left = oscillating(fit_with(1.0, around=around))
    assert left is not None
    assert (left.axis, left.variable) == ('v', 'oscillation')
    assert '1.3 times a second' in left.description
    assert left.strength == pytest.approx(2.0 / np.sqrt(2.0), rel=0.2)


def test_drum_that_turns_the_robot_is_a_torque() -> None:
    left = oscillating(fit_with(1.0, np.array([1.0, -1.0])))
    assert left is not None
    assert left.axis == 'omega'
    assert left.strength == pytest.approx(2.0 * 0.2 / np.sqrt(2.0), rel=0.2)


def test_drum_is_told_as_long_as_it_runs() -> None:
    running = np.clip((DRIVE.time - 30.0) * 1e3, 0.0, 1.0)[:, None]
    force = DRIVE.force + running * np.sin(2.0 * np.pi * 1.3 * DRIVE.time)[:, None]
    fit, _ = fitted(acted_otherwise(DRIVE, force, SMOOTH, 5))
    left = oscillating(fit)
    assert left is not None
    assert np.all(left.force[left.knots < 24.0] < 0.2)
    assert np.all(left.force[left.knots > 36.0] > 1.0)


@pytest.mark.parametrize('around', [SMOOTH, ROUGH])
def test_nothing_shakes_a_robot_that_is_left_alone(around: Surroundings) -> None:
    assert find_line(fit_with(0.0, around=around)) is None


def test_odometry_of_once_a_second_shows_no_line() -> None:
    drive = random_forces(5, 300.0, 2.0, 14.0)
    run = acted_otherwise(drive, drive.force)
    seen, rare = run.odometry, slice(None, None, round(1.0 / np.diff(run.odometry.time).mean()))
    told = replace(seen, time=seen.time[rare], twist=seen.twist[rare], pose=seen.pose[rare])
    fit, _ = fitted(replace(run, odometry=told))
    assert find_line(fit) is None


def test_run_that_is_too_short_shows_no_line() -> None:
    assert find_line(fit_with(1.0, seconds=20.0)) is None
