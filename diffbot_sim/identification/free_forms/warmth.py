"""How much a wheel has rolled lately: bearings and grease warm as they roll, and cool at rest."""

from dataclasses import dataclass
from math import exp
from typing import ClassVar

import numpy as np
from numba import types

from diffbot_sim.identification.fitting.views import View
from diffbot_sim.identification.free_forms.forms import Given
from diffbot_sim.physics.compiled import entry
from diffbot_sim.physics.dynamics import STRIDED_ARRAY, STRIDED_MATRIX
from diffbot_sim.records import Array

# For how long warmth stays [s], each tried alone.
TIMES = ((3.0,), (10.0,), (30.0,))


@dataclass(frozen=True)
class Warming(Given):
    """Friction in proportion to the mean speed of a wheel over its past, which fades in a time."""

    looked_at: ClassVar[int] = 1
    sets: tuple[tuple[float, ...], ...] = TIMES

    def columns(self, view: View, fading: Array) -> Array:
        """Evaluate mean speeds along a stretch, with the sense of the motion."""
        mean = lately(np.abs(view.wheel_speed), view.stretch.time, float(fading[0]))
        return np.asarray((np.sign(view.wheel_speed) * mean)[:, None])

    def curve(self, fading: Array) -> tuple[Array, Array]:
        """Return mean speeds of nothing and of 1 m/s, and the function there."""
        del fading
        return np.array([0.0, 1.0]), np.array([[0.0], [1.0]])


def lately(values: Array, time: Array, fading: float) -> Array:
    """Return means of the past, in which what was fades in a time [s]; before it was nothing.

    values, shape (k, 2).
    """
    mean = np.zeros(values.shape)
    _fade(time, values, fading, mean)
    return mean


@entry(types.void(STRIDED_ARRAY, STRIDED_MATRIX, types.float64, STRIDED_MATRIX))
def _fade(time: Array, values: Array, fading: float, mean: Array) -> None:
    """Let the mean follow the values from sample to sample, each held until the next."""
    for k in range(len(time) - 1):
        kept = exp(-(time[k + 1] - time[k]) / fading)
        for column in range(values.shape[1]):
            mean[k + 1, column] = kept * mean[k, column] + (1.0 - kept) * values[k, column]
