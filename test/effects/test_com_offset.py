"""Centre-of-gravity offset: it couples, and does no work."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from motion import kinetic_energy, numbers, push

from diffbot_sim.physics import Friction, Model
from diffbot_sim.physics.effects.com_offset import ComOffset
from diffbot_sim.physics.effects.slope import STANDARD_GRAVITY, Slope
from diffbot_sim.physics.state import State

SMOOTH = Friction('none')


@given(offset=st.floats(-0.3, 0.3), v=numbers(-2.0, 2.0), omega=numbers(-5.0, 5.0))
def test_com_offset_alone_conserves_energy(offset, v, omega):
    model = Model(friction=SMOOTH, effects=(ComOffset(offset),))
    run = push(model, 0.0, 0.0, 5.0, start=State(v=v, omega=omega), max_step=1e-3)
    sideways = 0.5 * model.robot.mass * (offset * run.twist[:, 1]) ** 2
    energy = kinetic_energy(model.robot, run) + sideways
    np.testing.assert_allclose(energy, energy[0], rtol=1e-8, atol=1e-12)


@given(offset=st.floats(-0.3, 0.3), heading=numbers(-3.0, 3.0), omega=numbers(-2.0, 2.0))
def test_robot_with_com_offset_swings_on_a_slope_without_losing_energy(offset, heading, omega):
    grade_x, grade_y = 0.05, -0.03
    model = Model(friction=SMOOTH, effects=(ComOffset(offset), Slope(grade_x, grade_y)))
    start = State(heading=heading, v=0.5, omega=omega)
    run = push(model, 0.0, 0.0, 5.0, start=start, max_step=1e-3)
    x, y, angle = run.pose.T
    height = grade_x * (x + offset * np.cos(angle)) + grade_y * (y + offset * np.sin(angle))
    potential = model.robot.mass * STANDARD_GRAVITY * height
    sideways = 0.5 * model.robot.mass * (offset * run.twist[:, 1]) ** 2
    energy = kinetic_energy(model.robot, run) + sideways + potential
    np.testing.assert_allclose(energy, energy[0], atol=1e-6)
