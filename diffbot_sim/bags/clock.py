"""Clocks that were set while a bag was recorded: stamps that leap, though receipts do not."""

from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from diffbot_sim.bags.series import Series
from diffbot_sim.records import NANOSECONDS

# A leap of less [s] is told by no receipt: messages wait so long for each other.
LEAST = 0.1
# Messages before and after a leap that tell by how much later than their stamps they are received.
AROUND = 50
# A message comes in time within so many usual intervals, and a clock leaps by this share of what
# the messages around tell: others came late, or were lost.
IN_TIME, SAME = 3.0, 0.2


class Leap(NamedTuple):
    """The first message after the clock was set, and by how much that was [ns]."""

    first: int
    by: int


def leaps(series: Series) -> Iterator[Leap]:
    """Yield where the clock of the stamps was set, as those of receipt tell."""
    if len(series.received) < 2 * AROUND or not series.has_stamps:
        return  # too short, or no clock at all
    steps, waits = np.diff(series.stamped), np.diff(series.received)
    usual, late = np.median(waits), series.received - series.stamped
    if abs(usual - np.median(steps)) > SAME * usual:
        return  # receipts are of another time, as those of a bag that was replayed fast
    leapt = steps - waits
    sudden = (np.abs(leapt) > LEAST * NANOSECONDS) & (waits < IN_TIME * usual)
    for first in np.flatnonzero(sudden) + 1:
        before, after = late[:first][-AROUND:], late[first:][:AROUND]
        by = np.median(before) - np.median(after)
        told = min(len(before), len(after)) == AROUND
        if told and abs(by - leapt[first - 1]) < SAME * abs(by):
            yield Leap(int(first), int(by))


def unset(series: Series, found: Iterable[Leap]) -> Series:
    """Return messages stamped as if their clock had not leapt so."""
    stamped = series.stamped.copy()
    for leap in found:
        stamped[leap.first :] -= leap.by
    return replace(series, stamped=stamped)
