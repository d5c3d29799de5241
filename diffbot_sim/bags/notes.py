"""What people should know of a recording before they believe what follows from it."""

from collections.abc import Iterable, Iterator, Mapping, Sequence

import numpy as np

from diffbot_sim.bags.clock import Leap
from diffbot_sim.bags.lost import lost
from diffbot_sim.bags.pauses import is_within
from diffbot_sim.bags.poses import is_filled
from diffbot_sim.bags.series import ABSURD, Ordered, Series, Stamps, silences
from diffbot_sim.records import LARGEST, NANOSECONDS, Run
from diffbot_sim.standing import turning, unfilled

MOST = 5  # holes that are told one by one
# Repeated stamps are told only where more than this share of the messages bears one.
OFTEN = 0.01


def notes_on(
    usable: Mapping[str, Ordered], run: Run, start: int, paused: Sequence[Stamps]
) -> Iterator[str]:
    """Yield a line for each thing that was noticed.

    usable: by its role, what each topic held; start: the moment of run time 0 [ns]; paused: the
    stamps around each time in which nothing was heard.
    """
    odom = usable['odom']
    for role, item in usable.items():
        yield from _left_out(item)
        if role == 'odom':
            yield from _told(item, silences(item), start, 'what happened there is unknown')
            continue
        yield from _lost(item)
        holes = [gap for gap in silences(item) if not is_within(gap, paused)]
        held = [gap for gap in holes if _goes_on(odom, gap)]
        yield from _told(item, held, start, 'the last force is taken to be held')
    if run.odometry.pose is None and is_filled(odom):
        yield 'the poses never turn though the twists do; used the twists alone'
    for name, empty in zip(('linear.x', 'angular.z'), unfilled(run.odometry), strict=True):
        if empty:
            yield (
                f'twist.{name} of {odom.topic} is 0 throughout though the poses move; identify '
                'takes the twists from the changes of the poses, nothing else does'
            )
    yield from _of_standing(run)


def notes_on_clock(series: Series, leaps: Iterable[Leap]) -> Iterator[str]:
    """Yield a line for each time that the clock of a topic's stamps was set."""
    for leap in leaps:
        at = (series.received[leap.first] - series.received[0]) / NANOSECONDS
        yield (
            f'the stamps of {series.topic} leap by {leap.by / NANOSECONDS:+.3g} s after '
            f'{at:.1f} s, its receipts do not; that was taken back'
        )


def _left_out(item: Ordered) -> Iterator[str]:
    if item.dropped:
        yield (
            f'left out {item.dropped} messages of {item.topic} that are not finite, or beyond '
            f'{LARGEST:g}'
        )
    if item.absurd:
        yield (
            f'left out {item.absurd} messages of {item.topic} whose numbers are more than '
            f'{ABSURD:g} times as large as nearly all others'
        )
    if item.repeated > OFTEN * len(item.stamp):
        many = len(item.stamp) + item.repeated
        yield (
            f'{item.repeated} of {many} messages of {item.topic} bear the stamp of another; '
            'used the last of each'
        )


def _lost(item: Ordered) -> Iterator[str]:
    missing = int(lost(item).sum()) - item.dropped - item.absurd
    if missing > 0:
        yield (
            f'{missing} messages of {item.topic} are missing, of {len(item.stamp) + missing}; '
            'those forces are taken to lie between their neighbours'
        )


def _goes_on(item: Ordered, gap: Stamps) -> bool:
    """Say whether a topic has messages within a gap of another."""
    begin, end = np.searchsorted(item.stamp, gap, side='right')
    return bool(end - begin > 1)


def _told(item: Ordered, gaps: Sequence[Stamps], start: int, consequence: str) -> Iterator[str]:
    if gaps:
        times = ', '.join(
            f'{(end - begin) / NANOSECONDS:.1f} s from {(begin - start) / NANOSECONDS:.1f} s on'
            for begin, end in gaps[:MOST]
        )
        more = f' and {len(gaps) - MOST} more' if len(gaps) > MOST else ''
        yield f'{item.topic} has holes: {times}{more}; {consequence}'


def _of_standing(run: Run) -> Iterator[str]:
    seen = turning(run)
    if seen.is_told:
        yield (
            f'odometry turns by {seen.rate:.4f} rad/s while the robot stands; '
            'identify takes that off as the bias of a gyro, nothing else does'
        )
