"""empirical_limit: a table that stands for any limit of force over speed."""

import numpy as np
import pytest
from motion import push

from diffbot_sim.physics import Friction, Model
from diffbot_sim.physics.effects import Effect
from diffbot_sim.physics.effects.actuator_saturation import ActuatorSaturation
from diffbot_sim.physics.effects.empirical_limit import PLACES, UNLIMITED, EmpiricalLimit
from diffbot_sim.physics.effects.power_limit import PowerLimit
from diffbot_sim.physics.state import State

SPEED, POWER = 1.2, 6.0
OF_POWER = [POWER / (place * SPEED) if place > 0.0 else UNLIMITED for place in PLACES]
TABLE = EmpiricalLimit(SPEED, 8.0, 6.0, 5.0, 4.0, 3.0, 2.0, 1.0)


def given(effect: Effect, asked: float, speed: float) -> float:
    """Return the force [N] that a wheel gets at a speed [m/s]."""
    model = Model(friction=Friction('none'), effects=(effect,))
    run = push(model, asked, asked, 0.01, every=0.01, start=State(v=speed))
    return float(run.traction[0, 0])


@pytest.mark.parametrize(
    ('law', 'points'), [(PowerLimit(POWER), OF_POWER), (ActuatorSaturation(5.0), [5.0] * 7)]
)
def test_a_table_moves_a_robot_as_the_law_that_it_holds(law, points):
    tables = (law, EmpiricalLimit(SPEED, *points))
    runs = [push(Model(effects=(it,)), 20.0, 12.0, 2.0) for it in tables]
    # Their corners are not alike: at the limit 0.5 % of the force are missing, or up to 6 %.
    np.testing.assert_allclose(runs[1].twist, runs[0].twist, rtol=5e-3, atol=1e-6)


@pytest.mark.parametrize(('speed', 'limit'), [(0.3, 4.0), (1.2, 1.0), (-0.6, 6.0), (-1.2, 8.0)])
@pytest.mark.parametrize('way', [1.0, -1.0])
def test_limit_is_that_of_the_speed_along_the_force(speed, limit, way):
    assert given(TABLE, way * 50.0, way * speed) == pytest.approx(way * limit, rel=1e-9)


@pytest.mark.parametrize(('speed', 'limit'), [(2.5, 1.0), (-3.0, 8.0)])
def test_beyond_its_ends_the_limit_stays_as_it_ends(speed, limit):
    assert given(TABLE, 50.0, speed) == pytest.approx(limit, rel=1e-9)


def test_between_points_the_reciprocal_changes_in_a_line():
    assert given(TABLE, 50.0, 0.45) == pytest.approx(2.0 / (1.0 / 4.0 + 1.0 / 3.0), rel=1e-9)


def test_what_is_far_below_the_limit_is_left_alone():
    assert given(TABLE, 0.1, 0.3) == 0.1
