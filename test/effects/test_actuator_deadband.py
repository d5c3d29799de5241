"""Actuator dead band: what is within it does nothing, the rest loses it."""

import numpy as np
import pytest
from hypothesis import given
from motion import drive, forces, numbers, push

from diffbot_sim.physics import Friction, Model
from diffbot_sim.physics.effects.actuator_deadband import ActuatorDeadband
from diffbot_sim.physics.effects.actuator_lag import ActuatorLag

SMOOTH = Friction('none')


@pytest.mark.parametrize('sign', [1.0, -1.0])
def test_force_loses_the_band_in_either_direction(sign):
    run = push(Model(effects=(ActuatorDeadband(1.5),)), sign * 4.0, -sign * 6.0, 0.1)
    assert (run.traction == (sign * 2.5, -sign * 4.5)).all()


@given(right=numbers(-1.5, 1.5), left=numbers(-1.5, 1.5))
def test_commands_within_the_band_move_not_even_a_robot_without_friction(right, left):
    run = push(Model(friction=SMOOTH, effects=(ActuatorDeadband(1.5),)), right, left, 2.0)
    assert not run.pose.any()
    assert not run.traction.any()


@given(band=numbers(0.0, 5.0), force=forces(20.0))
def test_free_robot_accelerates_by_what_exceeds_the_band(band, force):
    model = Model(friction=SMOOTH, effects=(ActuatorDeadband(band),))
    run = push(model, force, force, 2.0)
    excess = np.sign(force) * max(abs(force) - band, 0.0)
    v = 2.0 * excess / model.robot.mass * run.time
    np.testing.assert_allclose(run.twist[:, 0], v, rtol=1e-9, atol=1e-9)


def test_band_is_taken_from_the_command_before_it_lags():
    """A force that dies away slowly is not cut off where it enters the band."""
    model = Model(effects=(ActuatorDeadband(1.5), ActuatorLag(0.5)))
    run = drive(model, (0.0, 0.0, 0.0), (1.0, 4.0, 4.0), (5.0, 1.0, 1.0), until=9.0, every=1.0)
    rise, fall = -np.expm1(-2.0 * np.arange(5.0)), np.exp(-2.0 * np.arange(1.0, 5.0))
    expected = 2.5 * np.concatenate([[0.0], rise, rise[-1] * fall])
    np.testing.assert_allclose(run.traction[:, 0], expected, rtol=1e-9, atol=1e-12)
