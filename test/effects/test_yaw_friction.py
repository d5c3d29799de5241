"""Yaw friction: closed forms of a spin."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from motion import frictions, numbers, push
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.identification.fitting.fit import FIRST_GAINS
from diffbot_sim.identification.fitting.predictor import predict
from diffbot_sim.identification.recordings.stretches import whole
from diffbot_sim.physics import Friction, Model
from diffbot_sim.physics.effects.yaw_friction import YawFriction
from diffbot_sim.physics.state import State

SMOOTH = Friction('none')


@given(dry=st.floats(0.01, 2.0), omega=numbers(-5.0, 5.0))
def test_dry_yaw_friction_stops_a_spin_after_j_omega_squared_over_2_torque(dry, omega):
    model = Model(friction=SMOOTH, effects=(YawFriction(dry),))
    inertia, late = model.robot.inertia, model.robot.inertia * 5.0 / dry + 0.1
    run = push(model, 0.0, 0.0, late, every=late, start=State(omega=omega), max_step=0.1)
    turned = np.sign(omega) * inertia * omega**2 / (2.0 * dry)
    assert run.pose[-1, 2] == pytest.approx(turned, rel=1e-9)
    assert not run.twist[-1].any()


@given(viscous=st.floats(0.01, 2.0), omega=numbers(-5.0, 5.0))
def test_viscous_yaw_friction_lets_a_spin_fall_exponentially(viscous, omega):
    model = Model(friction=SMOOTH, effects=(YawFriction(viscous=viscous),))
    run = push(model, 0.0, 0.0, 2.0, start=State(omega=omega))
    expected = omega * np.exp(-viscous / model.robot.inertia * run.time)
    np.testing.assert_allclose(run.twist[:, 1], expected, rtol=1e-7, atol=1e-12)


@given(friction=frictions(), dry=numbers(0.0, 2.0), v=numbers(-2.0, 2.0))
def test_yaw_friction_does_not_touch_a_straight_drive(friction, dry, v):
    plain, start = Model(friction=friction), State(v=v)
    scrubbed = plain.with_effect(YawFriction(dry, 0.3))
    run, image = (push(model, 4.0, 4.0, 2.0, start=start) for model in (plain, scrubbed))
    np.testing.assert_allclose(image.twist, run.twist, rtol=1e-12, atol=1e-12)


def test_noise_that_turns_the_robot_back_and_forth_meets_no_friction_that_vanishes():
    run = rehearse(Model(), random_forces(2, 30.0, -9.0, 11.0), Surroundings(), 2)
    (stretch,) = whole([run])
    plain, vanishing = (
        predict(Model(effects=effects), stretch, FIRST_GAINS).innovation
        for effects in ((), (YawFriction(1e-9),))
    )
    np.testing.assert_allclose(vanishing, plain, atol=1e-6)
