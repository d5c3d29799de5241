"""Forces that come in bursts, depend on nothing, and push a robot harder than a floor does."""

import numpy as np
import pytest
from fits import ROUGH, acted_otherwise, fitted, leaving
from rehearsal import Surroundings

from diffbot_sim.identification import identify
from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.free_forms.bursts import bursts, bursts_still
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


@pytest.fixture(scope='module')
def cut_out() -> Fit:
    """Return a fit to a drive that cuts out."""
    return fitted(acted_otherwise(DRIVE, GIVEN))[0]


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


def test_bursts_are_told_over_time_and_as_what_they_are_like(cut_out: Fit) -> None:
    left = bursts(cut_out)
    assert left is not None
    assert 'as if the drives gave less' in left.description
    along = {'v': (1.0, 1.0), 'omega': (1.0, -1.0)}[left.axis]
    lacking = np.interp(left.knots, TIME, (GIVEN - FORCES) @ along)
    assert np.corrcoef(left.force, lacking)[0, 1] > 0.5


def test_bursts_are_told_of_older_twists_where_these_leave_errors_far_out(cut_out: Fit) -> None:
    noise = RANDOM.normal(size=(3000, 2))
    banged = noise + 10.0 * (RANDOM.random((3000, 1)) < 0.01)
    assert bursts_still(cut_out, leaving(noise)) is None
    assert bursts_still(cut_out, leaving(banged)) is not None
