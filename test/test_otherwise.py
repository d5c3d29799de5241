"""Held-out data in which a robot moves otherwise than where it was fitted."""

from dataclasses import replace

import numpy as np
import pytest
from fits import ROUGH, SMOOTH, acted_otherwise, fitted
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.identification import identify
from diffbot_sim.identification.free_forms.otherwise import excess_of, moves_otherwise
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects.slope import Slope
from diffbot_sim.physics.effects.wheel_ripple import WheelRipple

FORCES = random_forces(3, 60.0, -9.0, 11.0)
# A rope that gets caught when the last third of the drive begins.
HELD_BACK = FORCES.force - 0.6 * (FORCES.time > 43.0)[:, None]


@pytest.mark.parametrize('around', [SMOOTH, ROUGH])
def test_robot_that_stays_the_same_moves_as_before(around: Surroundings) -> None:
    assert moves_otherwise(*fitted(acted_otherwise(FORCES, FORCES.force, around))) is None


def test_force_that_sets_in_after_the_fit_is_noticed_and_measured() -> None:
    left = moves_otherwise(*fitted(acted_otherwise(FORCES, HELD_BACK)))
    assert left is not None
    assert left.axis == 'v'
    assert np.median(left.force) == pytest.approx(-1.2, abs=0.2)


def test_force_that_sets_in_after_the_fit_of_one_run_of_three_is_that_runs() -> None:
    fit, held_out = fitted(acted_otherwise(FORCES, FORCES.force))
    _, others = fitted(acted_otherwise(FORCES, FORCES.force, seed=4))
    _, caught = fitted(replace(acted_otherwise(FORCES, HELD_BACK), name='caught'))
    left = moves_otherwise(fit, [*held_out, *caught, *others])
    assert left is not None
    assert 'of caught alone' in left.description


def test_ripple_is_where_it_was_in_the_data_that_were_fitted() -> None:
    cogging = Model().with_effect(WheelRipple(order=3.0, right_cos=0.6, left_sin=0.6))
    drive = random_forces(5, 120.0, -9.0, 11.0)
    fit, held_out = fitted(rehearse(cogging, drive, SMOOTH, 5), cogging)
    assert np.all(excess_of(fit, held_out[0]) < 1.3)


def test_nothing_is_not_said_to_be_missing_where_held_out_data_say_otherwise() -> None:
    answer = identify([acted_otherwise(FORCES, HELD_BACK)], Model(), kinds=[Slope])
    assert answer.verdict == 'unexplained'
