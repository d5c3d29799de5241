"""Kinematics: eqs. (2)-(5), and (3) with the sign that follows from (2)."""

import numpy as np
import pytest
from hypothesis import assume, given
from motion import numbers, push

from diffbot_sim.physics import Friction, Model
from diffbot_sim.physics.kinematics import body_twist, turning_radius, wheel_speeds
from diffbot_sim.physics.state import State

speeds = numbers(-100.0, 100.0)
lengths = numbers(1e-3, 10.0)


@given(v=speeds, omega=speeds, b=lengths)
def test_twist_and_wheel_speeds_are_inverse(v, omega, b):
    assert body_twist(*wheel_speeds(v, omega, b), b) == pytest.approx((v, omega), abs=1e-9)


@given(right=speeds, left=speeds, b=lengths)
def test_radius_obeys_both_halves_of_equation_2(right, left, b):
    assume(abs(right - left) > 1e-6)
    radius, (_, omega) = float(turning_radius(right, left, b)), body_twist(right, left, b)
    assert omega * (radius + b) == pytest.approx(right, abs=1e-9)
    assert omega * (radius - b) == pytest.approx(left, abs=1e-9)


@given(right=speeds, left=speeds, b=lengths)
def test_radius_times_turning_rate_is_speed_as_in_equation_4(right, left, b):
    assume(abs(right - left) > 1e-6)
    v, omega = body_twist(right, left, b)
    assert turning_radius(right, left, b) * omega == pytest.approx(v, abs=1e-9)


@given(slow=numbers(0.0, 10.0), b=lengths)
def test_left_turn_has_its_centre_on_the_left(slow, b):
    """The printed (3) says the opposite."""
    assert turning_radius(slow + 1.0, slow, b) > 0.0


@given(speed=speeds, b=lengths)
def test_straight_drive_has_an_infinite_radius(speed, b):
    assert turning_radius(speed, speed, b) == np.inf


@given(right=speeds, left=speeds, b=lengths)
def test_swapped_wheels_turn_the_other_way(right, left, b):
    v, omega = body_twist(right, left, b)
    assert body_twist(left, right, b) == (v, -omega)


def test_radius_of_arrays_is_the_radius_of_each():
    right, left = np.array([1.0, 2.0, -1.0]), np.array([0.5, 2.0, 1.0])
    radii = [turning_radius(r, x, 0.2) for r, x in zip(right, left, strict=True)]
    np.testing.assert_array_equal(turning_radius(right, left, 0.2), radii)


@given(v=numbers(-2.0, 2.0), omega=numbers(-2.0, 2.0), heading=numbers(-7.0, 7.0))
def test_free_rolling_robot_draws_the_circle_of_equation_5(v, omega, heading):
    assume(abs(omega) > 0.1)
    free = Model(friction=Friction(model='none'))
    run = push(free, 0.0, 0.0, 2.0, start=State(1.0, 2.0, heading, v, omega))
    turned = heading + omega * run.time
    np.testing.assert_allclose(run.pose[:, 2], turned, atol=1e-9)
    x = 1.0 + v / omega * (np.sin(turned) - np.sin(heading))
    y = 2.0 - v / omega * (np.cos(turned) - np.cos(heading))
    np.testing.assert_allclose(run.pose[:, :2], np.column_stack([x, y]), atol=1e-9)


@given(right=numbers(-2.0, 2.0), left=numbers(-2.0, 2.0))
def test_wheels_roll_without_slip(right, left):
    free = Model(friction=Friction(model='none'))
    v, omega = body_twist(right, left, free.robot.half_separation)
    run = push(free, 0.0, 0.0, 2.0, start=State(v=v, omega=omega))
    rolled = run.wheel_angle[-1] * free.robot.wheel_radius
    assert rolled == pytest.approx((2.0 * right, 2.0 * left), abs=1e-9)
