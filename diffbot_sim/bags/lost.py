"""Force messages that a recording lost, of a topic that comes at a steady rate.

The robot may well have had them. Single ones are taken to lie between their neighbours; while a
topic is silent for long its last force is held. What may be wrong with either is told, so that
nobody takes it for a force that the model lacks.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from diffbot_sim.bags.series import Ordered, silence, silences, usual_spacing
from diffbot_sim.records import NANOSECONDS, Array

# A topic comes at a steady rate if nine in ten of its intervals are whole numbers of the usual
# one, within such a share of it, and few messages are missing from it. A slower one [ns] may be
# sent when forces change. What the next message follows sooner than half an interval was late.
STEADY, WITHIN, FEW, SOON = 0.9, 0.35, 0.25, 0.5
SLOWEST = NANOSECONDS // 5
# The median of a normal variable's size is this share of its deviation.
MEDIAN = 0.6745


def with_lost(force: Ordered) -> Ordered:
    """Return forces with those that were lost put in, shape (m, 2): force, how unsure it is.

    That is the variance of its impulse for each second, [N²·s], as Commands tell it.
    """
    taken = _with_single(force)
    return _with_silent(taken) if _is_steady(force) else taken


def lost(force: Ordered) -> NDArray[np.int64]:
    """Return how many single messages were lost after each one, shape (n,)."""
    return _skipped(force) if _is_steady(force) else np.zeros(len(force.stamp), np.int64)


def _is_steady(force: Ordered) -> bool:
    """Say whether a topic comes at a steady rate."""
    if usual_spacing(force) > SLOWEST:
        return False
    is_few = _skipped(force).sum() < FEW * len(force.stamp)
    return bool(_is_even(_steps(force)).mean() >= STEADY and is_few)


def _steps(force: Ordered) -> Array:
    """Return the usual intervals that pass after each message, shape (n,), one after the last."""
    return np.append(np.diff(force.stamp) / usual_spacing(force), 1.0)


def _is_even(steps: Array) -> NDArray[np.bool_]:
    return np.asarray(np.abs(steps - np.rint(steps)) < WITHIN)


def _skipped(force: Ordered) -> NDArray[np.int64]:
    """Return how many usual intervals passed after each message without one, but for silences.

    A message that is late is not missing.
    """
    steps = _steps(force)
    is_late = np.append(steps[1:], 1.0) < SOON
    is_short = steps * usual_spacing(force) < silence(force)
    skipped = np.maximum(np.rint(steps) - 1.0, 0.0)
    return np.where(_is_even(steps) & is_short & ~is_late, skipped, 0.0).astype(np.int64)


def _with_single(force: Ordered) -> Ordered:
    """Return forces with single ones that were lost put in, and how unsure they are."""
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


def _with_silent(force: Ordered) -> Ordered:
    """Return forces of which those that are held through a silence are unsure, too.

    As much as any, from one usual interval after the last on.
    """
    gaps = silences(force)
    begins = np.array([begin for begin, _ in gaps], np.int64)
    lasting = np.array([end - begin for begin, end in gaps]) / NANOSECONDS
    last, size = np.searchsorted(force.stamp, begins), force.values[:, 0]
    rows = np.column_stack([size[last], lasting * size.var()])
    return replace(
        force,
        stamp=np.insert(force.stamp, last + 1, begins + int(usual_spacing(force))),
        values=np.insert(force.values, last + 1, rows, axis=0),
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
