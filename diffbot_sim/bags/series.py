"""What one topic held: stamps put in order, unusable messages left out."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diffbot_sim.errors import BagError
from diffbot_sim.records import LARGEST, NANOSECONDS, Array

Stamps = NDArray[np.int64]

# A clock that jumps further [ns] has been reset, or the bag holds two drives.
LONGEST_STEP_BACK = NANOSECONDS
LONGEST_GAP = 3600 * NANOSECONDS
MOST_UNUSABLE, MOST_REPEATED = 0.01, 0.5
# A topic has a hole where it is silent for longer than this [s], and than so many usual intervals.
LONGEST_SILENCE, USUAL_SILENCES = 1.0, 10.0
# What is so many times as large as all but 1 % of what is not 0, and as what is usual within so
# many messages around, is no measurement.
ABSURD, ALL_BUT, AROUND = 100.0, 0.99, 50


@dataclass(frozen=True)
class Series:
    """The messages of one topic.

    received, stamped: times of receipt and of the header [ns], shape (n,), in order of receipt.
    values: shape (n, m); measured: of how many columns the numbers are those of motion or force,
    not of a place, which may be anywhere.
    """

    topic: str
    received: Stamps
    stamped: Stamps
    values: Array
    measured: int

    @property
    def has_stamps(self) -> bool:
        """Whether the headers are filled; a simulation clock may start at 0, none before."""
        told = self.stamped > 0
        if np.count_nonzero(~told) > 1:
            return False
        return bool(told.all() or np.min(self.stamped[told], initial=LONGEST_GAP) <= LONGEST_GAP)


@dataclass(frozen=True)
class Ordered:
    """Usable messages: stamps [ns], shape (n,), increasing; values, shape (n, m), finite.

    dropped, absurd, repeated: how many were left out because they were not finite, or out of all
    proportion, or because a later one has their stamp.
    """

    topic: str
    stamp: Stamps
    values: Array
    dropped: int
    absurd: int
    repeated: int


def ordered(series: Series, stamp: Stamps) -> Ordered:
    """Sort by stamps of one clock; of equal stamps keep the last; leave out what is unusable.

    That is what is not finite, and the few whose numbers are out of all proportion.
    Raises BagError when the clock jumps, most stamps are those of other messages that tell
    something else, or more than 1 % of the messages are not finite.
    """
    _check_clock(series.topic, stamp)
    finite = _is_finite(series)
    _check_finite(series.topic, finite)
    sane = finite.copy()
    sane[finite] = ~_absurd(series.values[finite, : series.measured])
    stamp, values = stamp[sane], series.values[sane]
    order = np.argsort(stamp, kind='stable')
    last = np.append(np.diff(stamp[order]) > 0, True)
    repeated = int(np.count_nonzero(~last))
    contrary = np.count_nonzero(~last[:-1] & np.any(np.diff(values[order], axis=0), axis=1))
    if contrary > MOST_REPEATED * len(stamp):
        raise BagError(
            f'{series.topic}: {repeated} of {len(stamp)} messages bear the stamp of another one; '
            'its clock stands still. Stamp each message when it is measured, or leave the stamps '
            '0: then the times of receipt are used.'
        )
    kept = order[last]
    dropped, absurd = np.count_nonzero(~finite), np.count_nonzero(finite & ~sane)
    return Ordered(series.topic, stamp[kept], values[kept], int(dropped), int(absurd), repeated)


def usual_spacing(series: Ordered) -> float:
    """Return the median time between messages [ns]; endless where there are not two."""
    return float(np.median(np.diff(series.stamp))) if len(series.stamp) > 1 else np.inf


def silence(series: Ordered) -> float:
    """Return for how long a topic must be silent to have a hole there, or an end [ns]."""
    usual = usual_spacing(series) if len(series.stamp) > 1 else 0.0
    return max(LONGEST_SILENCE * NANOSECONDS, USUAL_SILENCES * usual)


def silences(series: Ordered) -> list[Stamps]:
    """Return the stamps around each time for which a topic is silent far longer than usual."""
    holes = np.flatnonzero(np.diff(series.stamp) > silence(series))
    return [series.stamp[i : i + 2] for i in holes]


def _is_finite(series: Series) -> NDArray[np.bool_]:
    """Return which messages are finite, and tell of no more than any robot does."""
    measured = np.abs(series.values[:, : series.measured]) <= LARGEST
    return np.asarray(np.isfinite(series.values).all(axis=1) & measured.all(axis=1))


def _check_finite(topic: str, finite: NDArray[np.bool_]) -> None:
    dropped = np.count_nonzero(~finite)
    if dropped > MOST_UNUSABLE * len(finite):
        raise BagError(
            f'{topic}: {dropped} of {len(finite)} messages hold NaN, infinity or '
            f'numbers beyond {LARGEST:g}, which is too many to leave out. Mend their source and '
            'record again.'
        )


def _absurd(values: Array) -> NDArray[np.bool_]:
    """Return which rows hold a number out of all proportion to most others, and to those around.

    A robot that moves for moments only is no mistake: what is around is alike then.
    """
    sizes = np.abs(values)
    proportion = [
        np.quantile(size[size > 0.0], ALL_BUT, method='lower') if size.any() else np.inf
        for size in sizes.T
    ]
    beyond = sizes > ABSURD * np.array(proportion)
    for row in np.flatnonzero(beyond.any(axis=1)):
        around = sizes[max(0, row - AROUND) : row + AROUND + 1]
        beyond[row] &= sizes[row] > ABSURD * np.median(around, axis=0)
    return np.asarray(beyond.any(axis=1))


def _check_clock(topic: str, stamp: Stamps) -> None:
    jumps = np.diff(stamp)
    wild = jumps[(jumps < -LONGEST_STEP_BACK) | (jumps > LONGEST_GAP)]
    if wild.size:
        raise BagError(
            f'{topic}: its clock jumps by {wild[0] / NANOSECONDS:g} s; was it reset during the '
            'recording? Record each drive into a bag of its own.'
        )
