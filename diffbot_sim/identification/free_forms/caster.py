"""What a caster drags: it rolls where it has swivelled to, and swivels as the robot moves.

Its wheel trails a pivot and does not slip sideways, so speed and yaw rate turn it; where the robot
turns back it swings round. Rolling and swivelling rub, each with a friction that has the sense of
its motion; what that does to the body follows from virtual power.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from math import ceil, cos, sin
from typing import ClassVar

import numpy as np
from numba import types

from diffbot_sim.identification.fitting.views import View, on_wheels
from diffbot_sim.physics.compiled import compiled, entry
from diffbot_sim.physics.dynamics import ARRAY, STRIDED_ARRAY
from diffbot_sim.records import Array

# Where the pivot may be, ahead of the axle, and how far the wheel may trail it: shares of half
# the wheel separation.
AHEAD, TRAIL = (-2.0, -1.0, 1.0, 2.0), (0.1, 0.3)
# Friction has the sense of a motion that is faster than this [m/s].
SLOW = 0.01
# The longest step in which a caster swivels [rad].
LONGEST = 0.1
POINTS = 41


@dataclass(frozen=True)
class Caster:
    """Friction of rolling and of swivelling, as forces of unit size at the wheel of a caster."""

    looked_at: ClassVar[int] = 1

    def grids(self, views: Sequence[View]) -> list[Array]:
        """Return where the pivot is and how far the wheel trails it [m]."""
        half = views[0].fit.model.half_separation
        return [half * np.array(place) for place in product(AHEAD, TRAIL)]

    def columns(self, view: View, place: Array) -> Array:
        """Evaluate both frictions along a stretch, as a force on the right and the left wheel."""
        (ahead, trail), half = place, view.fit.model.half_separation
        angle = swivelled(view.stretch.time, view.v, view.omega, ahead, trail)
        along, across = np.cos(angle), np.sin(angle)
        # How fast the wheel rolls and is pushed round, by the body's speed and its yaw rate.
        rolls = np.stack([along, ahead * across])
        swivels = np.stack([-across, ahead * along - trail])
        twist = np.stack([view.v, view.omega])
        pushes = [-np.tanh(np.sum(by * twist, axis=0) / SLOW) * by for by in (rolls, swivels)]
        return np.stack([on_wheels(push.T, half) for push in pushes], axis=1)

    def curve(self, place: Array) -> tuple[Array, Array]:
        """Return angles of the caster and what both do along the robot there, while it drives."""
        del place
        angle = np.linspace(-np.pi, np.pi, POINTS)
        return angle, np.column_stack([-np.cos(angle), np.sin(angle)])


def swivelled(time: Array, v: Array, omega: Array, ahead: float, trail: float) -> Array:
    """Return the rolling direction of a caster, counted from straight ahead [rad], shape (k,).

    ahead, trail [m]: of its pivot before the axle, and of its wheel behind the pivot. It begins
    as after a drive straight ahead.
    """
    angle = np.zeros(len(time))
    _swivel(time, v, omega, ahead, trail, angle)
    return angle


@compiled
def _rate(angle: float, v: float, omega: float, ahead: float, trail: float) -> float:
    """Return how fast a caster swivels at an angle [rad/s], its wheel not slipping sideways."""
    return (ahead * omega * cos(angle) - v * sin(angle)) / trail - omega


@entry(
    types.void(STRIDED_ARRAY, STRIDED_ARRAY, STRIDED_ARRAY, types.float64, types.float64, ARRAY)
)
def _swivel(time: Array, v: Array, omega: Array, ahead: float, trail: float, angle: Array) -> None:
    """Follow the pivot from sample to sample, in steps of a midpoint rule."""
    for k in range(len(time) - 1):
        span = time[k + 1] - time[k]
        fastest = (abs(v[k]) + abs(ahead * omega[k])) / trail + abs(omega[k])
        count = ceil(fastest * span / LONGEST) + 1
        step, at = span / count, angle[k]
        for _ in range(count):
            middle = at + 0.5 * step * _rate(at, v[k], omega[k], ahead, trail)
            at += step * _rate(middle, v[k], omega[k], ahead, trail)
        angle[k + 1] = at
