"""Twists that trackers make of noisy poses: differences, smoothed over some samples.

Where they are smoothed to both sides they are not late, and still hide what is fast. They tell
by their noise: it is that of the poses.
"""

import numpy as np

from diffbot_sim.identification.statistics.robust import influence, scale_of
from diffbot_sim.records import Array

# Differences of this order leave noise alone.
ORDER = 4
# The correlation from which on noise is shared, and at which distances [samples] it is looked for.
SHARED, FARTHEST = 0.3, 12
# Twists with so much less noise than the pose's changes are smoothed for long enough to matter.
LONG = 8.0


def smoothed_over(moved: Array, told: Array) -> int:
    """Return over how many samples to a side told rates were smoothed, 0 if not for long.

    moved: changes of a pose over time, told: the rate at the end of each, both of shape (k,).
    """
    changes, rates = (np.diff(values, n=ORDER)[:, None] for values in (moved, told))
    if _usual(changes) <= LONG * _usual(rates):
        return 0
    first, second = (influence(v / scale_of(v)).ravel() for v in (changes, rates))
    shifts = range(-FARTHEST, FARTHEST + 1)
    shared = [abs(_correlation(first, second, shift)) for shift in shifts]
    best = int(np.argmax(shared))
    return max(1, abs(shifts[best])) if shared[best] > SHARED else 0


def _usual(differences: Array) -> float:
    """Return the median size of what is any: noise is there always, kinks of a motion seldom."""
    size = np.abs(differences)
    return float(np.median(size[size > 0.0])) if np.any(size) else 0.0


def _correlation(first: Array, second: Array, shift: int) -> float:
    """Return the correlation of one series with another so many samples later."""
    early, late = (first, second) if shift >= 0 else (second, first)
    count = len(first) - abs(shift)
    return float(np.corrcoef(early[:count], late[abs(shift) :])[0, 1])
