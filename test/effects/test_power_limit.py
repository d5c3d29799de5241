"""power_limit: a body under constant power has the kinetic energy P t."""

import numpy as np
import pytest
from motion import push

from diffbot_sim.physics import Friction, Model
from diffbot_sim.physics.effects.power_limit import PowerLimit, weakened
from diffbot_sim.physics.state import State

LIMITED = Model(friction=Friction('none'), effects=(PowerLimit(4.0),))


def test_speed_grows_with_the_root_of_time():
    run = push(LIMITED, 50.0, 50.0, 3.0, start=State(v=1.0))
    expected = np.sqrt(1.0 + 2.0 * 8.0 / LIMITED.robot.mass * run.time)
    np.testing.assert_allclose(run.twist[:, 0], expected, rtol=1e-6)


def test_slow_wheels_and_brakes_without_a_limit_get_what_is_asked():
    for force, v in ((-50.0, 1.0), (50.0, 1e-4)):
        run = push(LIMITED, force, force, 0.01, every=0.01, start=State(v=v))
        np.testing.assert_array_equal(run.traction[0], force)


def test_brakes_take_no_more_than_their_power():
    model = Model(friction=Friction('none'), effects=(PowerLimit(4.0, 2.0),))
    run = push(model, -50.0, -50.0, 0.1, every=0.1, start=State(v=1.0))
    np.testing.assert_allclose(run.traction[0], -2.0)


def test_moving_robot_has_nearly_its_full_force_at_the_limit():
    limit, speed = 4.0, 1.0
    assert weakened(limit / speed, speed, limit, limit) > 0.99 * limit / speed


@pytest.mark.parametrize('speed', [0.5, 3.0, 5.0, 11.0])
@pytest.mark.parametrize('times', [1.5, 5.0, 10.0, 19.0, 30.0])
def test_fast_wheel_gets_what_the_limit_leaves_however_much_is_asked(speed, times):
    limit = 4.0 / speed
    assert weakened(times * limit, speed, 4.0, 4.0) == pytest.approx(limit, rel=0.01)
    assert weakened(-times * limit, -speed, 4.0, 4.0) == pytest.approx(-limit, rel=0.01)
