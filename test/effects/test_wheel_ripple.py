"""Wheel ripple: a potential along the angle of each wheel, which can hold a wheel or tear it."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from motion import forces, kinetic_energy, numbers, push

from diffbot_sim.physics import Friction, Model
from diffbot_sim.physics.effects.wheel_ripple import WheelRipple
from diffbot_sim.physics.state import State

SMOOTH = Friction('none')
STATIC = Friction().law().static
amplitudes = st.tuples(*[forces(2.0)] * 4)


def ripple_of(effect, angle):
    """Return the force [N] of either wheel at its angle."""
    cosine = np.array([effect.right_cos, effect.left_cos])
    sine = np.array([effect.right_sin, effect.left_sin])
    return cosine * np.cos(effect.order * angle) + sine * np.sin(effect.order * angle)


@given(
    order=st.floats(0.5, 12.0), sizes=amplitudes, v=numbers(-1.0, 1.0), omega=numbers(-1.0, 1.0)
)
def test_robot_without_friction_keeps_the_sum_of_motion_and_ripple_energy(order, sizes, v, omega):
    effect = WheelRipple(order, *sizes)
    model = Model(friction=SMOOTH, effects=(effect,))
    run = push(model, 0.0, 0.0, 3.0, start=State(v=v, omega=omega), max_step=1e-3)
    # The potential is the force a quarter of a period further on, times r/n.
    quarter = ripple_of(effect, run.wheel_angle + 0.5 * np.pi / order)
    potential = model.robot.wheel_radius / order * quarter.sum(axis=1)
    energy = kinetic_energy(model.robot, run) + potential
    np.testing.assert_allclose(energy, energy[0], rtol=1e-6, atol=1e-7)


@given(order=st.floats(0.05, 20.0), sizes=amplitudes, right=forces(10.0), left=forces(10.0))
def test_each_wheel_feels_the_ripple_of_its_own_angle(order, sizes, right, left):
    effect = WheelRipple(order, *sizes)
    run = push(Model(effects=(effect,)), right, left, 2.0)
    added = run.traction - (right, left)
    np.testing.assert_allclose(added, ripple_of(effect, run.wheel_angle), atol=1e-12)


@given(share=st.floats(0.1, 1.9), sine=forces(10.0), sign=st.sampled_from([1.0, -1.0]))
def test_ripple_moves_a_resting_robot_only_above_static_friction(share, sine, sign):
    """At angle 0 only the cosine acts."""
    cosine = sign * share * STATIC
    run = push(Model(effects=(WheelRipple(4.0, cosine, sine, cosine, sine),)), 0.0, 0.0, 0.5)
    moved = sign * run.wheel_angle[-1]
    assert (moved == 0.0).all() if share < 0.999 else (moved >= 0.0).all()
    assert (moved > 0.0).all() or share < 1.001


def test_ripple_tears_one_wheel_loose_while_the_other_stays_stuck():
    model = Model(effects=(WheelRipple(1.0, 1.2 * STATIC),))
    run = push(model, 0.0, 0.0, 0.3)
    assert run.wheel_speed[-1, 0] > 0.0
    assert not run.wheel_angle[:, 1].any()


@given(order=st.floats(1.0, 12.0), size=st.floats(0.1, 2.0), v=st.floats(-1.0, 1.0))
def test_ripple_is_constant_on_a_wheel_that_has_come_to_rest(order, size, v):
    effect = WheelRipple(order, 0.0, size, 0.0, size)
    run = push(Model(effects=(effect,)), 0.0, 0.0, 10.0, start=State(v=v))
    late = run.time >= 9.0
    assert not run.wheel_speed[late].any()
    assert (run.traction[late] == run.traction[-1]).all()
    np.testing.assert_allclose(run.friction[late], run.traction[late], rtol=1e-12)


def test_weak_push_rolls_only_into_the_first_rise_of_a_strong_ripple():
    """Without friction it swings there for ever; with friction it comes to rest."""
    hill = WheelRipple(6.0, 0.0, -5.0, 0.0, -5.0)
    run = push(Model(effects=(hill,)), 4.0, 4.0, 10.0)
    assert 0.0 < run.wheel_angle[-1, 0] < 0.5 * np.pi / 6.0
    assert not run.wheel_speed[-1].any()
