"""Slope: gravity fixed in the world."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from motion import numbers, push

from diffbot_sim.physics import Friction, Model
from diffbot_sim.physics.effects.slope import STANDARD_GRAVITY, Slope
from diffbot_sim.physics.state import State

SMOOTH = Friction('none')


@given(grade_x=numbers(-0.1, 0.1), grade_y=numbers(-0.1, 0.1), heading=numbers(-7.0, 7.0))
def test_slope_pulls_along_the_heading(grade_x, grade_y, heading):
    model = Model(friction=SMOOTH, effects=(Slope(grade_x, grade_y),))
    run = push(model, 0.0, 0.0, 2.0, start=State(heading=heading))
    pull = -STANDARD_GRAVITY * (grade_x * np.cos(heading) + grade_y * np.sin(heading))
    np.testing.assert_allclose(run.twist[:, 0], pull * run.time, rtol=1e-9, atol=1e-12)
    assert not run.twist[:, 1].any()


@given(grade=numbers(-0.1, 0.1), omega=st.floats(0.5, 3.0))
def test_slope_is_fixed_in_the_world_while_the_robot_turns(grade, omega):
    model = Model(friction=SMOOTH, effects=(Slope(grade),))
    run = push(model, 0.0, 0.0, 3.0, start=State(omega=omega))
    expected = -STANDARD_GRAVITY * grade * np.sin(omega * run.time) / omega
    np.testing.assert_allclose(run.twist[:, 0], expected, atol=1e-8)


@given(share=st.floats(0.1, 1.9), sign=st.sampled_from([1.0, -1.0]))
def test_static_friction_holds_the_robot_on_a_slope_up_to_its_limit(share, sign):
    nominal = Model()
    limit = 2.0 * nominal.friction.law().static / (nominal.robot.mass * STANDARD_GRAVITY)
    run = push(nominal.with_effect(Slope(sign * share * limit)), 0.0, 0.0, 5.0)
    moved = -sign * run.pose[-1, 0]
    assert moved == 0.0 if share < 0.999 else moved >= 0.0
    assert moved > 0.0 or share < 1.001
