"""Force messages that a recording lost: single ones of a topic that comes at a steady rate.

The robot may well have had them. They are taken to lie between their neighbours, and what may be
wrong with that is told, so that nobody takes it for a force that the model lacks.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from diffbot_sim.bags.series import NANOSECONDS, Ordered, silence
from diffbot_sim.records import Array

# A topic comes at a steady rate if nine in ten of its intervals are whole numbers of the usual
# one, within such a share of it, and few messages are missing from it. A slower one [ns] may be
# sent when forces change.
STEADY, WITHIN, FEW = 0.9, 0.25, 0.25
SLOWEST = NANOSECONDS // 5
# The median of a normal variable's size is this share of its deviation.
MEDIAN = 0.6745


def lost(force: Ordered) -> NDArray[np.int64]:
    """Return how many messages were lost after each one, shape (n,); none if the rate varies.

    Where a topic is silent for long it was not sent.
    """
    steps, none = np.diff(force.stamp), np.zeros(len(force.stamp), np.int64)
    usual = float(np.median(steps)) if steps.size else np.inf
    if usual > SLOWEST:
        return none
    whole = np.maximum(np.rint(steps / usual), 1.0)
    even = np.abs(steps / usual - whole) < WITHIN
    missing = np.where(even & (steps < silence(force)), whole - 1.0, 0.0)
    is_steady = even.mean() >= STEADY and missing.sum() < FEW * len(steps)
    return np.append(missing, 0.0).astype(np.int64) if is_steady else none


def with_lost(force: Ordered) -> Ordered:
    """Return forces with those that were lost put in, shape (m, 2): force, how unsure it is.

    That is the variance of its impulse for each second, [N²·s], as Commands tell it.
    """
    missing, size = lost(force), force.values[:, 0]
    place = np.repeat(np.arange(len(size)), 1 + missing)
    within = np.arange(len(place)) - np.searchsorted(place, place)
    share = within / (1 + missing[place])
    step, gap = (np.append(np.diff(it), 0) for it in (size, force.stamp))
    unheard = gap * missing / (1 + missing) / NANOSECONDS
    variance = unheard * (_between(size, missing) + 0.25 * step**2)
    return replace(
        force,
        stamp=force.stamp[place] + np.rint(share * gap[place]).astype(np.int64),
        values=np.column_stack(
            [size[place] + share * step[place], np.where(within > 0, variance[place], 0.0)]
        ),
    )


def _between(size: Array, missing: NDArray[np.int64]) -> Array:
    """Return the usual variance of forces [N²] half way between some that far apart, shape (n,).

    0 where none is missing.
    """
    variance = np.zeros(len(size))
    for many in np.unique(missing[missing > 0]):
        first, last = size[: -1 - many], size[1 + many :]
        apart = size[(1 + many) // 2 :][: len(first)] - 0.5 * (first + last)
        variance[missing == many] = (np.median(np.abs(apart)) / MEDIAN) ** 2
    return variance
