"""Friction drift: closed forms of coasting and of breakaway while friction changes."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from motion import push, table

from diffbot_sim.physics import Friction, Model, simulate
from diffbot_sim.physics.effects.friction_drift import FrictionDrift
from diffbot_sim.physics.state import State
from diffbot_sim.records import Commands

COULOMB, VISCOUS = Friction('coulomb'), Friction('coulomb_viscous', mu_coulomb=0.0)


def progress_until(time, tau):
    """Return the integral of 1 - exp(-t/τ) from 0."""
    return time + tau * np.expm1(-time / tau)


@given(change=st.floats(-0.95, 5.0), tau=st.floats(1.0, 30.0), speed=st.floats(-3.0, 3.0))
def test_drifting_viscous_friction_slows_a_free_robot_as_its_integral_says(change, tau, speed):
    model = Model(friction=VISCOUS, effects=(FrictionDrift(0.0, change, tau),))
    run = push(model, 0.0, 0.0, 10.0, start=State(v=speed))
    spent = 2.0 * VISCOUS.law().viscous * (run.time + change * progress_until(run.time, tau))
    expected = speed * np.exp(-spent / model.robot.mass)
    np.testing.assert_allclose(run.twist[:, 0], expected, rtol=1e-7, atol=1e-12)


@given(change=st.floats(-0.95, -0.4), share=st.floats(0.65, 0.95), tau=st.floats(1.0, 10.0))
def test_friction_that_wanes_lets_a_pushed_robot_loose_at_its_moment(change, share, tau):
    model = Model(friction=COULOMB, effects=(FrictionDrift(change, 0.0, tau),))
    limit, until = COULOMB.law().static, 30.0
    run = push(model, share * limit, share * limit, until, every=until, max_step=0.05)
    loose = -tau * np.log(1.0 - (share - 1.0) / change)
    gone = progress_until(until, tau) - progress_until(loose, tau)
    v = 2.0 * limit / model.robot.mass * ((share - 1.0) * (until - loose) - change * gone)
    assert run.twist[-1, 0] == pytest.approx(v, rel=1e-7)


@pytest.mark.parametrize('effect', [FrictionDrift(0.5, 0.0, 5.0), FrictionDrift(0.0, 0.5, 5.0)])
def test_wear_slows_a_driven_robot_and_warm_up_speeds_it_up(effect):
    warm = FrictionDrift(-effect.dry, -effect.viscous, 5.0)
    worn, plain, eased = (
        push(Model(effects=drifts), 4.0, 4.0, 20.0).twist[-1, 0]
        for drifts in ((effect,), (), (warm,))
    )
    assert worn < plain < eased


def test_before_the_start_of_the_run_friction_has_not_changed():
    """A drive may be given on a clock that starts later; friction must not turn negative."""
    drive = Commands(np.array([-50.0]), np.array([[5.0, 4.0]]))
    times = np.linspace(-50.0, 0.0, 101)
    plain = simulate(Model(), drive, times)
    changed = simulate(Model(effects=(FrictionDrift(20.0, 20.0, 1.0),)), drive, times)
    np.testing.assert_array_equal(table(changed), table(plain))
