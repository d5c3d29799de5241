"""What winds up as a wheel rolls: tyres and belts, and friction that yields over a way.

It pulls back more and more as the wheel rolls on, up to a limit, and the other way once the wheel
turns back: Dahl, A solid friction model, 1968. What a wheel did before its last turn still counts.
"""

from dataclasses import dataclass
from math import exp
from typing import ClassVar

import numpy as np
from numba import types

from diffbot_sim.identification.fitting.views import View
from diffbot_sim.identification.free_forms.forms import Given
from diffbot_sim.physics.compiled import entry
from diffbot_sim.physics.dynamics import MATRIX, STRIDED_ARRAY, STRIDED_MATRIX
from diffbot_sim.records import Array

# Ways in which a wheel winds up [m], each tried alone.
WAYS = ((0.03,), (0.1,), (0.3,))
# What is drawn: so many points of so many ways after turning back.
POINTS, DRAWN = 41, 4.0


@dataclass(frozen=True)
class Winding(Given):
    """How far each wheel has wound up, from -1 to 1 of what it can."""

    looked_at: ClassVar[int] = 1
    sets: tuple[tuple[float, ...], ...] = WAYS

    def columns(self, view: View, way: Array) -> Array:
        """Evaluate it along a stretch, at whose start nothing is wound up."""
        return wound(view.stretch.time, view.wheel_speed, float(way[0]))[:, None]

    def curve(self, way: Array) -> tuple[Array, Array]:
        """Return ways since a wheel turned back that had been wound up, and what it is there."""
        since = np.linspace(0.0, DRAWN, POINTS)
        return since * way[0], (1.0 - 2.0 * np.exp(-since))[:, None]


def wound(time: Array, speed: Array, way: float) -> Array:
    """Return how far wheels have wound up that do so in a way [m], shape (k, 2)."""
    parts = np.zeros_like(speed)
    _wind(time, speed, way, parts)
    return parts


@entry(
    types.void(
        STRIDED_ARRAY,
        STRIDED_MATRIX,
        types.float64,
        MATRIX,
    )
)
def _wind(time: Array, speed: Array, way: float, parts: Array) -> None:
    """Wind each wheel up from sample to sample, at the speed that it has at the first of both."""
    for k in range(len(time) - 1):
        for wheel in range(2):
            rolled = speed[k, wheel] * (time[k + 1] - time[k]) / way
            most = 1.0 if rolled > 0.0 else -1.0
            parts[k + 1, wheel] = most + (parts[k, wheel] - most) * exp(-abs(rolled))
