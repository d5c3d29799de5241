"""What swings on a robot: a load that hangs or sloshes, a mast that bends.

It pushes back in proportion to how far, and how fast, it swings; what drives it is the robot's own
acceleration.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import cos, exp, sin, sqrt
from typing import ClassVar

import numpy as np
from numba import types

from diffbot_sim.identification.fitting.views import View
from diffbot_sim.physics.compiled import entry
from diffbot_sim.physics.dynamics import MATRIX, STRIDED_ARRAY
from diffbot_sim.records import Array

# Rates [Hz] so close that what swings at any rate between is seen, and its damping ratio.
RATES = tuple(np.geomspace(0.3, 5.0, 15).tolist())
DAMPING = 0.07
# What is drawn: so many points of so many periods after a jump of the speed.
POINTS, PERIODS = 61, 3.0


@dataclass(frozen=True)
class Swinging:
    """What swings at a rate, driven by the changes of a speed: its cosine and its sine part."""

    of: Callable[[View], Array]
    looked_at: ClassVar[int] = 1

    def grids(self, views: Sequence[View]) -> list[Array]:
        """Return each rate [Hz]."""
        del views
        return [np.array([rate]) for rate in RATES]

    def columns(self, view: View, rate: Array) -> Array:
        """Evaluate both parts along a stretch, at whose start nothing swings."""
        return swung(view.stretch.time, self.of(view), float(rate[0]))[..., None]

    def curve(self, rate: Array) -> tuple[Array, Array]:
        """Return times after a jump of the speed by one unit [s] and both parts there."""
        time = np.linspace(0.0, PERIODS / float(rate[0]), POINTS)
        return time, swung(time, np.append(0.0, np.ones(POINTS - 1)), float(rate[0]))


def swung(time: Array, speed: Array, rate: float) -> Array:
    """Return both parts of what swings at a rate [Hz] as a speed changes, shape (k, 2)."""
    parts = np.zeros((len(time), 2))
    _swing(time, speed, 2.0 * np.pi * rate, parts)
    return parts


@entry(types.void(STRIDED_ARRAY, STRIDED_ARRAY, types.float64, MATRIX))
def _swing(time: Array, speed: Array, omega: float, parts: Array) -> None:
    """Let an oscillator ring with each change of a speed, half of it before and half after."""
    turn = omega * sqrt(1.0 - DAMPING**2)
    for k in range(len(time) - 1):
        step, half = time[k + 1] - time[k], 0.5 * (speed[k + 1] - speed[k])
        left, c, s = exp(-DAMPING * omega * step), cos(turn * step), sin(turn * step)
        first, second = parts[k, 0] + half, parts[k, 1]
        parts[k + 1, 0] = left * (c * first - s * second) + half
        parts[k + 1, 1] = left * (s * first + c * second)
