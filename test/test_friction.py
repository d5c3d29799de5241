"""Friction of one wheel: eqs. (12), (13) with the corrections to the printed (13)."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from motion import frictions, numbers, push

from diffbot_sim.errors import ConfigError
from diffbot_sim.physics import Friction, Model
from diffbot_sim.physics.friction import MODELS, friction_force
from diffbot_sim.physics.state import State

speeds = numbers(-100.0, 100.0)
externals = numbers(-1e4, 1e4)
RUBBER = Friction(mu_static=0.5, mu_coulomb=0.2, mu_viscous=0.3, stribeck=10.0, normal_force=10.0)


@given(friction=frictions(), speed=speeds, external=externals)
def test_friction_is_odd(friction, speed, external):
    """The viscous term of the printed (13) breaks this for v < 0."""
    forward = friction_force(friction, speed, external)
    assert friction_force(friction, -speed, -external) == -forward


@given(friction=frictions(), speed=speeds)
def test_friction_never_pushes(friction, speed):
    assume(speed != 0.0)
    assert friction_force(friction, speed, 0.0) * speed >= 0.0


@given(friction=frictions(), share=numbers(-1.0, 1.0))
def test_resting_wheel_takes_any_force_up_to_static_friction(friction, share):
    external = share * friction.law().static
    assert friction_force(friction, 0.0, external) == external


@given(friction=frictions(), external=externals)
def test_resting_wheel_never_takes_more_than_static_friction(friction, external):
    static = friction.law().static
    assume(abs(external) > static)
    assert friction_force(friction, 0.0, external) == np.sign(external) * static


@given(friction=frictions(models=('generalized',)))
def test_friction_forces_are_coefficients_times_normal_force(friction):
    law, normal = friction.law(), friction.normal_force
    assert law.static == friction.mu_static * normal
    assert law.coulomb == friction.mu_coulomb * normal
    assert law.viscous == friction.mu_viscous * normal


@pytest.mark.parametrize(
    ('model', 'at_rest', 'slow', 'fast'),
    [
        ('none', 0.0, 0.0, 0.0),
        ('coulomb', 2.0, 2.0, 2.0),
        ('coulomb_stiction', 5.0, 2.0, 2.0),
        ('coulomb_viscous', 2.0, 2.0 + 3e-9, 2.0 + 30.0),
        ('generalized', 5.0, 5.0 - 3e-8 + 3e-9, 2.0 + 30.0),
    ],
)
def test_each_basic_model_uses_its_own_terms(model, at_rest, slow, fast):
    friction = Friction(model, 10.0, 0.5, 0.2, 0.3, 10.0)
    values = friction_force(friction, np.array([0.0, 1e-9, 10.0]), 1000.0)
    np.testing.assert_allclose(values, [at_rest, slow, fast], rtol=1e-12)


def test_generalized_friction_falls_to_a_minimum_and_rises_again():
    force = friction_force(RUBBER, np.linspace(1e-9, 2.0, 400), 0.0)
    lowest = int(np.argmin(force))
    assert (np.diff(force[: lowest + 1]) < 0.0).all()
    assert (np.diff(force[lowest:]) > 0.0).all()


@given(speed=numbers(1e-3, 50.0))
def test_generalized_friction_is_equation_13_forward_and_backward(speed):
    expected = 2.0 + (5.0 - 2.0) * np.exp(-10.0 * speed) + 3.0 * speed
    assert friction_force(RUBBER, speed, 0.0) == pytest.approx(expected)
    assert friction_force(RUBBER, -speed, 0.0) == pytest.approx(-expected)


@given(friction=frictions(), pairs=st.lists(st.tuples(speeds, externals), min_size=1))
def test_friction_of_arrays_is_the_friction_of_each(friction, pairs):
    speed, external = np.array(pairs).T
    each = [float(friction_force(friction, *pair)) for pair in pairs]
    np.testing.assert_array_equal(friction_force(friction, speed, external), each)


@given(friction=frictions(), v=numbers(-2.0, 2.0), omega=numbers(-2.0, 2.0))
def test_rolling_wheels_rub_as_the_law_says(friction, v, omega):
    run = push(Model(friction=friction), 0.3, -0.4, 0.1, start=State(v=v, omega=omega))
    rolls = run.wheel_speed != 0.0
    expected = friction_force(friction, run.wheel_speed, 0.0)
    np.testing.assert_allclose(run.friction[rolls], expected[rolls], rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize('model', ['coulomb_stiction', 'generalized'])
def test_sliding_friction_above_static_friction_is_refused(model):
    with pytest.raises(ConfigError, match=r'mu_coulomb: 0\.3 exceeds .* 0\.2; .*Raise mu_static'):
        Friction(model=model, mu_static=0.2, mu_coulomb=0.3)


@pytest.mark.parametrize('model', [m for m in MODELS if 'mu_static' not in Friction(m).active])
def test_a_model_without_static_friction_takes_any_coefficients(model):
    assert Friction(model=model, mu_static=0.2, mu_coulomb=0.3).law().static <= 0.3 * 49.05
