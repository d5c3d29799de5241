"""Bag to run."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from diffbot_sim.bags.clock import leaps, unset
from diffbot_sim.bags.known import apart, known
from diffbot_sim.bags.lost import with_lost
from diffbot_sim.bags.notes import notes_on, notes_on_clock
from diffbot_sim.bags.pauses import pauses
from diffbot_sim.bags.poses import pose_of, without_broken
from diffbot_sim.bags.series import Ordered, Series, Stamps, ordered
from diffbot_sim.bags.storage import naming, read_series
from diffbot_sim.bags.suspect import suspicions
from diffbot_sim.bags.topics import Topics
from diffbot_sim.errors import BagError
from diffbot_sim.files import spelled
from diffbot_sim.records import NANOSECONDS, Array, Commands, Odometry, Run, held

FEWEST = 50


@dataclass(frozen=True)
class RecordedRun:
    """A run, when it began, and what was noticed while reading it.

    start_ns: the moment of run time 0 on the recording's clock [ns].
    notes: one line each, for people; pauses: when nothing was heard, from and to [s].
    """

    run: Run
    start_ns: int
    notes: tuple[str, ...] = ()
    pauses: tuple[tuple[float, float], ...] = ()

    @property
    def stamps(self) -> Stamps:
        """When the odometry was measured [ns], shape (k,)."""
        return self.start_ns + np.rint(self.run.odometry.time * NANOSECONDS).astype(np.int64)


def read_run(path: str | Path, topics: Topics | None = None) -> RecordedRun:
    """Read one robot's run from a rosbag2 folder, or from one .mcap or .db3 file.

    Run time 0 is the first stamp of forces and odometry. Raises BagError.
    """
    place = Path(path)
    name = spelled(place.stem if place.is_file() else place.resolve().name)
    with naming(path):
        return _recorded(name, read_series(place, topics or Topics()))


def _recorded(name: str, series: Mapping[str, Series]) -> RecordedRun:
    mended, clock_notes = _mended(series)
    usable, stamp_notes = _usable(mended)
    forces = usable['left_force'], usable['right_force']
    stamps = np.union1d(*(force.stamp for force in forces))
    _check_overlap(stamps, usable['odom'].stamp)
    odom, bounds = known(usable['odom'], forces)
    _check_count(odom)
    start = int(min(stamps[0], odom.stamp[0]))
    run = Run(name, _commands(*forces, start), _odometry(odom, start))
    paused = pauses(usable)
    found = (*notes_on(usable, run, start, paused), *bounds, *suspicions(usable, run))
    spans = (map(float, _seconds(gap, start)) for gap in paused)
    unheard = tuple((begin, end) for begin, end in spans)
    notes = tuple(f'{name}: {note}' for note in (*clock_notes, *stamp_notes, *found))
    return RecordedRun(run, start, notes, unheard)


def _mended(series: Mapping[str, Series]) -> tuple[dict[str, Series], list[str]]:
    """Return what topics held without stamps that leap and poses that are broken, and notes."""
    leapt = {role: tuple(leaps(item)) for role, item in series.items()}
    notes = [note for role, item in series.items() for note in notes_on_clock(item, leapt[role])]
    whole = without_broken(series['odom'])
    if whole is not series['odom']:
        notes.append('the poses hold NaN or infinity; used the twists alone')
    mended = {**series, 'odom': whole}
    return {role: unset(item, leapt[role]) for role, item in mended.items()}, notes


def _usable(series: Mapping[str, Series]) -> tuple[dict[str, Ordered], list[str]]:
    """Return what each topic held, by one clock, and a note where that is not the stamps'.

    Times of receipt trail the stamps by an unknown delay: they serve for all or for none.
    """
    if all(item.has_stamps for item in series.values()):
        return {role: ordered(item, item.stamped) for role, item in series.items()}, []
    received = {role: ordered(item, item.received) for role, item in series.items()}
    return received, ['not all messages are stamped; used the times of receipt']


def _commands(left: Ordered, right: Ordered, start: int) -> Commands:
    """Return what both wheels were commanded, those that were lost among it."""
    wheels = with_lost(right), with_lost(left)
    stamps = np.union1d(*(wheel.stamp for wheel in wheels))
    told = np.stack([held(wheel.stamp, wheel.values, stamps) for wheel in wheels], axis=-1)
    force, unsure = told[:, 0], told[:, 1]
    return Commands(_seconds(stamps, start), force, unsure if unsure.any() else None)


def _odometry(odom: Ordered, start: int) -> Odometry:
    time = _seconds(odom.stamp, start)
    return Odometry(time, np.ascontiguousarray(odom.values[:, :2]), pose_of(odom, time))


def _check_overlap(force: Stamps, odom: Stamps) -> None:
    if force[-1] < odom[0] or odom[-1] < force[0]:
        raise apart('forces', force, odom)


def _check_count(odom: Ordered) -> None:
    if len(odom.stamp) < FEWEST:
        raise BagError(
            f'{len(odom.stamp)} odometry messages; at least {FEWEST} are needed while forces are '
            'known.'
        )


def _seconds(stamp: Stamps, start: int) -> Array:
    seconds: Array = (stamp - start) / NANOSECONDS
    return seconds
