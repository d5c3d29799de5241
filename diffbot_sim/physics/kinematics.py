"""Kinematics of the differential drive: eqs. (2)-(5)."""

from typing import TypeVar

import numpy as np

from diffbot_sim.records import Array

Number = TypeVar('Number', float, Array)


def body_twist(
    speed_right: Number, speed_left: Number, half_separation: float
) -> tuple[Number, Number]:
    """Return v [m/s] and ω [rad/s] of the axle midpoint from wheel speeds [m/s]: (4), (2).

    And way [m] and turn [rad] from the ways of the wheels [m]; single numbers or arrays.
    """
    v = 0.5 * (speed_right + speed_left)
    omega = (speed_right - speed_left) / (2.0 * half_separation)
    return v, omega


def wheel_speeds(v: float, omega: float, half_separation: float) -> tuple[float, float]:
    """Return the wheel speeds [m/s], right and left: the inverse of (2) and (4)."""
    return v + half_separation * omega, v - half_separation * omega


def turning_radius(speed_right: Array, speed_left: Array, half_separation: float) -> Array:
    """Return R_o [m] of the arc about the ICC, inf when driving straight.

    Eq. (3) with the sign that follows from (2); the printed denominator has it reversed.
    """
    difference = np.asarray(speed_right, float) - speed_left
    total = np.asarray(speed_right, float) + speed_left
    with np.errstate(divide='ignore', invalid='ignore'):
        return np.where(difference == 0.0, np.inf, half_separation * total / difference)


def path_of(pose: Array) -> Array:
    """Return way ahead [m] and heading [rad], shape (k, 2), from poses (k, 3)."""
    step, middle = np.diff(pose, axis=0), 0.5 * (pose[1:, 2] + pose[:-1, 2])
    chord = step[:, 0] * np.cos(middle) + step[:, 1] * np.sin(middle)
    # An arc is longer than its chord.
    ahead = chord / np.sinc(step[:, 2] / (2.0 * np.pi))
    return np.column_stack([np.concatenate([[0.0], np.cumsum(ahead)]), pose[:, 2]])


def integral(time: Array, rate: Array) -> Array:
    """Return the integral of a measured rate from the first stamp on, by trapezoids."""
    steps = np.diff(time) * 0.5 * (rate[1:] + rate[:-1])
    return np.concatenate([[0.0], np.cumsum(steps)])
