"""The loop of both wheels: limited references, and a model that knows the force in advance."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from diffbot_sim.control.feed_forward import wheel_forces
from diffbot_sim.control.loop import Acceleration, InnerLoop, LoopSettings
from diffbot_sim.control.pi import Gains, wheel_rates
from diffbot_sim.physics import Friction, Model, Plant, Robot

DT = 0.01
LIMITED = Acceleration(linear=0.5, angular=2.0)


def follow(settings, wanted, seconds):
    """Drive a simulated robot; return its twists and the references as twists."""
    robot, plant, loop = (
        settings.robot,
        Plant(Model(settings.robot, settings.friction)),
        InnerLoop(),
    )
    measured, asked = [], []
    for _ in range(round(seconds / DT)):
        rates = wheel_rates(*plant.twist, robot)
        output = loop.step(settings, wheel_rates(*wanted, robot), rates, DT)
        plant.step(*output.force, DT)
        measured.append(plant.twist)
        asked.append(np.mean(output.reference) * robot.wheel_radius)
    return np.array(measured), np.array(asked)


@given(st.floats(-1.0, 1.0), st.floats(0.2, 2.0))
def test_references_change_no_faster_than_the_limit(v, seconds):
    _, asked = follow(LoopSettings(acceleration=LIMITED), (v, 0.0), seconds)
    assert np.abs(np.diff(asked, prepend=0.0)).max() <= 0.5 * DT * (1.0 + 1e-9)
    assert asked[-1] == pytest.approx(np.sign(v) * min(abs(v), 0.5 * seconds), abs=0.5 * DT)


def test_without_limits_references_are_what_is_asked():
    _, asked = follow(LoopSettings(), (0.7, 0.0), 0.1)
    np.testing.assert_allclose(asked, 0.7, rtol=1e-12)


def test_a_model_that_is_right_leaves_the_sums_little_to_do():
    gains = Gains(kp=1.0, ki=0.0)
    bare = LoopSettings(acceleration=LIMITED, pi=gains)
    knowing = LoopSettings(feed_forward=1.0, acceleration=LIMITED, pi=gains)
    missed = [
        np.abs(measured[50:, 0] - asked[50:]).max()
        for measured, asked in (follow(s, (0.8, 0.5), 3.0) for s in (bare, knowing))
    ]
    assert missed[1] < 0.05 * missed[0]


@given(st.floats(-1.0, 1.0), st.floats(-2.0, 2.0), st.floats(-1.0, 1.0), st.floats(-3.0, 3.0))
def test_without_friction_the_model_gives_newtons_law(v, omega, a, alpha):
    robot = Robot()
    right, left = wheel_forces(robot, Friction('none'), (v, omega), (a, alpha))
    assert right + left == pytest.approx(robot.mass * a, abs=1e-9)
    torque = (right - left) * robot.half_separation
    assert torque == pytest.approx(robot.inertia * alpha, abs=1e-9)


def test_a_reset_forgets_sums_and_references():
    settings, loop = LoopSettings(acceleration=LIMITED), InnerLoop()
    first = loop.step(settings, (5.0, 5.0), (0.0, 0.0), DT)
    loop.step(settings, (5.0, 5.0), (0.0, 0.0), 1.0)
    loop.reset()
    assert loop.step(settings, (5.0, 5.0), (0.0, 0.0), DT) == first
