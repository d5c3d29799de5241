"""How much a wheel has rolled lately: bearings and grease warm as they roll, and cool at rest."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from diffbot_sim.identification.fitting.views import View
from diffbot_sim.identification.free_forms.forms import Given
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
    """Return means of the past, in which what was fades in a time [s]; before it was nothing."""
    mean = np.zeros_like(values)
    kept = np.exp(-np.diff(time) / fading)
    for k, share in enumerate(kept):
        mean[k + 1] = share * mean[k] + (1.0 - share) * values[k]
    return mean
