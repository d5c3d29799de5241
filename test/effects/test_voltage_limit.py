"""voltage_limit: on full force a body nears the no-load speed as its closed form says."""

import numpy as np
import pytest
from motion import push

from diffbot_sim.physics import Friction, Model
from diffbot_sim.physics.effects.actuator_gain import ActuatorGain
from diffbot_sim.physics.effects.voltage_limit import VoltageLimit
from diffbot_sim.physics.state import State

LIMITED = Model(friction=Friction('none'), effects=(VoltageLimit(10.0, 0.8),))


def test_speed_nears_no_load_speed_exponentially():
    run = push(LIMITED, 500.0, 500.0, 2.0)
    time_constant = LIMITED.robot.mass * 0.8 / (2.0 * 10.0)
    expected = 0.8 * (1.0 - np.exp(-run.time / time_constant))
    np.testing.assert_allclose(run.twist[:, 0], expected, rtol=1e-6, atol=1e-9)


@pytest.mark.parametrize(('braking', 'force'), [(0.0, 10.0), (1.0, 18.75), (-1.0, 1.25)])
def test_braking_is_limited_as_at_rest_or_more_or_less_the_faster(braking, force):
    model = Model(friction=Friction('none'), effects=(VoltageLimit(10.0, 0.8, braking),))
    run = push(model, -500.0, -500.0, 0.01, every=0.01, start=State(v=0.7))
    np.testing.assert_allclose(run.traction[0], -force, rtol=1e-9)


def test_what_is_far_below_the_limit_is_left_alone():
    run = push(LIMITED, 1.0, 1.0, 0.01, every=0.01, start=State(v=0.1))
    np.testing.assert_allclose(run.traction[0], 1.0, rtol=1e-6)


def test_limit_is_one_of_the_motors_own_whatever_the_gain_behind_it():
    run = push(LIMITED.with_effect(ActuatorGain(0.2)), 500.0, 500.0, 0.01, every=0.01)
    np.testing.assert_allclose(run.traction[0], (12.0, 8.0), rtol=1e-9)
