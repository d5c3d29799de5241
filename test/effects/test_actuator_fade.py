"""Actuator fade: integrals of a gain that falls straight, or ever slower."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from motion import drive, forces, push

from diffbot_sim.physics import Friction, Model
from diffbot_sim.physics.effects.actuator_fade import ActuatorFade

SMOOTH, COULOMB = Friction('none'), Friction('coulomb')


@given(rate=st.floats(1e-3, 0.05), sign=st.sampled_from([1.0, -1.0]), force=forces(20.0))
def test_exponential_gain_gives_the_speed_of_its_integral(rate, sign, force):
    model = Model(friction=SMOOTH, effects=(ActuatorFade(sign * rate, sign * rate),))
    run = push(model, force, force, 60.0, every=1.0, max_step=0.1)
    lasting = -np.expm1(-sign * rate * run.time) / (sign * rate)
    v = 2.0 * force / model.robot.mass * lasting
    np.testing.assert_allclose(run.twist[:, 0], v, rtol=1e-9, atol=1e-12)


@given(rate=st.floats(-0.05, 0.016), force=forces(20.0))
def test_straight_gain_gives_the_speed_of_its_integral(rate, force):
    model = Model(friction=SMOOTH, effects=(ActuatorFade(rate),))
    run = push(model, force, force, 60.0, every=1.0, max_step=0.1)
    v = 2.0 * force / model.robot.mass * (run.time - 0.5 * rate * run.time**2)
    np.testing.assert_allclose(run.twist[:, 0], v, rtol=1e-9, atol=1e-12)


@given(rate=st.floats(0.01, 0.05), bend=st.floats(0.1, 1.0))
def test_bent_gain_comes_to_a_level(rate, bend):
    run = push(Model(effects=(ActuatorFade(rate, bend),)), 8.0, 8.0, 400.0, every=400.0)
    assert run.traction[-1, 0] == pytest.approx(8.0 * (1.0 - rate / bend), rel=1e-9)


@given(share=st.floats(0.5, 0.95), rate=st.floats(0.02, 0.05))
def test_growing_gain_tears_a_resting_robot_loose_when_it_reaches_static_friction(share, rate):
    model = Model(friction=COULOMB, effects=(ActuatorFade(-rate),))
    limit, until = COULOMB.law().static, 60.0
    run = push(model, share * limit, share * limit, until, every=until, max_step=0.1)
    loose = (1.0 / share - 1.0) / rate
    pushed = share * 0.5 * rate * (until - loose) ** 2
    v = 2.0 * limit / model.robot.mass * pushed
    assert run.twist[-1, 0] == pytest.approx(v, rel=1e-7)


def test_gain_counts_time_from_the_start_of_the_run_not_of_the_command():
    run = drive(Model(effects=(ActuatorFade(0.005),)), (50.0, 4.0, 3.0), until=60.0, every=10.0)
    np.testing.assert_allclose(run.traction[5:, 0], [3.0, 2.8], rtol=1e-15)


@pytest.mark.parametrize('fade', [(-0.05, 0.0), (0.05, -0.05), (-0.05, -0.05)])
def test_change_without_end_stays_finite(fade):
    late = push(Model(effects=(ActuatorFade(*fade),)), 1.0, 1.0, 1e5, every=1e5, max_step=10.0)
    assert np.isfinite(late.twist).all()
