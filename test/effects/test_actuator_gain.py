"""Actuator gain: unequal wheels, and why there is no common factor."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from motion import drive, drives, forces, models, numbers, push

from diffbot_sim.physics import Friction, Model, Robot
from diffbot_sim.physics.effects.actuator_gain import ActuatorGain

SMOOTH = Friction('none')


@given(imbalance=numbers(-0.9, 0.9), right=forces(20.0), left=forces(20.0))
def test_free_robot_accelerates_by_the_forces_times_their_gains(imbalance, right, left):
    model = Model(friction=SMOOTH, effects=(ActuatorGain(imbalance),))
    run, robot = push(model, right, left, 2.0), model.robot
    acting_right, acting_left = right * (1.0 + imbalance), left * (1.0 - imbalance)
    v = (acting_right + acting_left) / robot.mass * run.time
    omega = robot.half_separation * (acting_right - acting_left) / robot.inertia * run.time
    np.testing.assert_allclose(run.twist, np.column_stack([v, omega]), rtol=1e-9, atol=1e-9)


@given(imbalance=numbers(-0.9, 0.9), model=models(), rows=drives())
def test_swapped_wheels_with_the_opposite_imbalance_give_the_mirrored_motion(
    imbalance, model, rows
):
    run = drive(model.with_effect(ActuatorGain(imbalance)), *rows, until=2.5)
    swapped = [(time, left, right) for time, right, left in rows]
    image = drive(model.with_effect(ActuatorGain(-imbalance)), *swapped, until=2.5)
    assert (image.pose == run.pose * (1.0, -1.0, -1.0)).all()
    assert (image.wheel_speed == run.wheel_speed[:, ::-1]).all()


@given(gain=st.floats(0.2, 5.0), rows=drives(20.0))
def test_factor_common_to_both_wheels_is_one_of_mass_inertia_and_friction(gain, rows):
    """So it has no parameter: no drive tells the two apart."""
    larger = [(time, gain * right, gain * left) for time, right, left in rows]
    heavier = Model(Robot(10.0 / gain, 0.4 / gain), Friction(normal_force=49.05 / gain))
    run, image = drive(Model(), *larger, until=2.5), drive(heavier, *rows, until=2.5)
    np.testing.assert_allclose(image.twist, run.twist, rtol=1e-6, atol=1e-9)
