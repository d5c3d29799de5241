"""Quadratic drag: its closed form."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from motion import numbers, push

from diffbot_sim.physics import Friction, Model
from diffbot_sim.physics.effects.quadratic_drag import QuadraticDrag
from diffbot_sim.physics.state import State

SMOOTH = Friction('none')


@given(coefficient=st.floats(0.1, 10.0), speed=numbers(-5.0, 5.0))
def test_drag_slows_a_free_robot_along_a_hyperbola(coefficient, speed):
    model = Model(friction=SMOOTH, effects=(QuadraticDrag(coefficient),))
    run = push(model, 0.0, 0.0, 3.0, start=State(v=speed))
    expected = speed / (1.0 + coefficient * abs(speed) * run.time / model.robot.mass)
    np.testing.assert_allclose(run.twist[:, 0], expected, rtol=1e-7, atol=1e-12)
