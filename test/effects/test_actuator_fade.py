"""Actuator fade: integrals of an exponential."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from motion import drive, forces, push

from diffbot_sim.physics import Friction, Model
from diffbot_sim.physics.effects.actuator_fade import ActuatorFade

SMOOTH, COULOMB = Friction('none'), Friction('coulomb')


@given(rate=st.floats(1e-3, 0.05), sign=st.sampled_from([1.0, -1.0]), force=forces(20.0))
def test_free_robot_gains_speed_as_the_integral_of_the_gain_says(rate, sign, force):
    model = Model(friction=SMOOTH, effects=(ActuatorFade(sign * rate),))
    run = push(model, force, force, 60.0, every=1.0, max_step=0.1)
    lasting = -np.expm1(-sign * rate * run.time) / (sign * rate)
    v = 2.0 * force / model.robot.mass * lasting
    np.testing.assert_allclose(run.twist[:, 0], v, rtol=1e-9, atol=1e-12)


@given(share=st.floats(0.5, 0.95), rate=st.floats(0.02, 0.05))
def test_growing_gain_tears_a_resting_robot_loose_when_it_reaches_static_friction(share, rate):
    model = Model(friction=COULOMB, effects=(ActuatorFade(-rate),))
    limit, until = COULOMB.law().static, 40.0
    run = push(model, share * limit, share * limit, until, every=until, max_step=0.1)
    loose = np.log(1.0 / share) / rate
    pushed = share * (np.exp(rate * until) - np.exp(rate * loose)) / rate - (until - loose)
    v = 2.0 * limit / model.robot.mass * pushed
    assert run.twist[-1, 0] == pytest.approx(v, rel=1e-7)


def test_gain_counts_time_from_the_start_of_the_run_not_of_the_command():
    run = drive(Model(effects=(ActuatorFade(0.02),)), (50.0, 4.0, 3.0), until=60.0, every=10.0)
    np.testing.assert_allclose(run.traction[5:, 0], 4.0 * np.exp([-1.0, -1.2]), rtol=1e-15)


def test_growth_without_end_stays_finite():
    late = push(Model(effects=(ActuatorFade(-0.05),)), 1.0, 1.0, 1e5, every=1e5, max_step=10.0)
    assert np.isfinite(late.twist).all()
