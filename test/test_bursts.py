"""Forces that come in bursts, depend on nothing, and push a robot harder than a floor does."""

from dataclasses import replace

import numpy as np
import pytest
from fits import ROUGH, acted_otherwise, fitted
from rehearsal import Surroundings

from diffbot_sim.identification import identify
from diffbot_sim.identification.free_forms.bursts import bursts
from diffbot_sim.identification.free_forms.near_rest import eased
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects.slope import Slope
from diffbot_sim.records import Commands

RANDOM = np.random.default_rng(1)
TIME = np.arange(0.0, 60.0, 0.02)
# So restless a drive that a wheel starts or stops within a second of every moment.
FORCES = RANDOM.choice([-10.0, -7.0, 7.0, 10.0], size=(100, 2))[(TIME / 0.6).astype(int)]
DRIVE = Commands(TIME, FORCES)
CUT_OUT = RANDOM.random(120)[(TIME / 0.5).astype(int)] < 0.1
GIVEN = FORCES * ~CUT_OUT[:, None]


@pytest.mark.parametrize('roughness', [0.0, 0.3, 0.9])
def test_floor_does_not_push_in_bursts(roughness: float) -> None:
    around = Surroundings(roughness=roughness)
    assert bursts(fitted(acted_otherwise(DRIVE, FORCES, around))[0]) is None


@pytest.mark.parametrize('roughness', [0.0, 0.3])
def test_drive_that_cuts_out_is_unexplained(roughness: float) -> None:
    around = Surroundings(roughness=roughness)
    answer = identify([acted_otherwise(DRIVE, GIVEN, around)], Model(), kinds=[Slope])
    assert answer.verdict == 'unexplained'
    assert answer.unexplained is not None
    assert 'comes in bursts' in answer.unexplained.description


def test_brake_that_lets_go_late_is_not_allowed_for_as_friction() -> None:
    pushes, into = np.divmod(TIME, 2.25)
    size = RANDOM.uniform(5.0, 10.0, (27, 2))[pushes.astype(int)]
    stop_and_go = size * np.select([into < 0.6, into < 1.0], [1.0, -1.0], 0.0)[:, None]
    held = stop_and_go * (into > 0.3)[:, None]
    run = acted_otherwise(Commands(TIME, stop_and_go), held, ROUGH)
    eased_fit, _ = eased(*fitted(run))
    assert not np.any(eased_fit.stretches[0].pushes)


def test_bursts_are_told_over_time_and_as_what_they_are_like() -> None:
    left = bursts(fitted(acted_otherwise(DRIVE, GIVEN))[0])
    assert left is not None
    assert 'as if the drives gave less' in left.description
    along = {'v': (1.0, 1.0), 'omega': (1.0, -1.0)}[left.axis]
    lacking = np.interp(left.knots, TIME, (GIVEN - FORCES) @ along)
    assert np.corrcoef(left.force, lacking)[0, 1] > 0.5


def test_knocks_that_no_noise_model_follows_are_told() -> None:
    knocked = (RANDOM.random(3000) < 0.005)[:, None] * np.array([60.0, 60.0])
    left = bursts(fitted(acted_otherwise(DRIVE, FORCES + knocked))[0])
    assert left is not None
    assert left.axis == 'v'


def test_odometry_that_is_at_fault_for_moments_tells_of_no_force() -> None:
    run = acted_otherwise(DRIVE, FORCES)
    at_fault = 0.2 * (RANDOM.random((3000, 2)) < 0.005)
    wrong = replace(run.odometry, twist=run.odometry.twist + at_fault)
    assert bursts(fitted(replace(run, odometry=wrong))[0]) is None
