"""Bag to run."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from diffbot_sim.bags.messages import yaw
from diffbot_sim.bags.series import NANOSECONDS, Ordered, Series, Stamps, held, ordered
from diffbot_sim.bags.storage import read_series
from diffbot_sim.bags.topics import Topics
from diffbot_sim.errors import BagError
from diffbot_sim.records import Array, Commands, Odometry, Run
from diffbot_sim.standing import turning

FEWEST = 50
# A hole in the odometry is longer than this [s], and than this many usual intervals.
LONGEST_SILENCE, USUAL_SILENCES = 1.0, 10.0
MOST = 5  # holes that are told one by one


@dataclass(frozen=True)
class RecordedRun:
    """A run, when it began, and what was noticed while reading it.

    start_ns: the moment of run time 0 on the recording's clock [ns].
    notes: one line each, for people.
    """

    run: Run
    start_ns: int
    notes: tuple[str, ...] = ()

    @property
    def stamps(self) -> Stamps:
        """When the odometry was measured [ns], shape (k,)."""
        return self.start_ns + np.rint(self.run.odometry.time * NANOSECONDS).astype(np.int64)


def read_run(path: str | Path, topics: Topics | None = None) -> RecordedRun:
    """Read one robot's run from a rosbag2 folder, or from one .mcap or .db3 file.

    Run time 0 is the first stamp of forces and odometry. Raises BagError.
    """
    place = Path(path)
    name = place.stem if place.is_file() else place.resolve().name
    try:
        return _recorded(name, read_series(place, topics or Topics()))
    except BagError as error:
        raise BagError(f'{path}: {error}') from error


def _recorded(name: str, series: Mapping[str, Series]) -> RecordedRun:
    # One clock for all three: times of receipt trail the stamps by an unknown delay.
    by_header = all(item.has_stamps for item in series.values())
    usable = {role: ordered(item, by_header) for role, item in series.items()}
    left, right, odom = usable['left_force'], usable['right_force'], usable['odom']
    stamps = np.union1d(left.stamp, right.stamp)
    _check_span(stamps, odom.stamp)
    start = int(min(stamps[0], odom.stamp[0]))
    force = np.column_stack([held(right, stamps), held(left, stamps)])
    run = Run(name, Commands(_seconds(stamps, start), force), _odometry(odom, start))
    notes = [*_notes(name, series, usable, by_header), *_of_standing(run)]
    return RecordedRun(run, start, tuple(notes))


def _odometry(odom: Ordered, start: int) -> Odometry:
    twist = np.ascontiguousarray(odom.values[:, :2])
    pose = np.column_stack([odom.values[:, 2:4], np.unwrap(yaw(odom.values[:, 4:]))])
    return Odometry(_seconds(odom.stamp, start), twist, pose if _is_pose(odom.values) else None)


def _is_pose(values: Array) -> bool:
    """Tell poses from fields that nobody filled: no orientation, or at the origin for ever."""
    oriented = bool(np.all(np.linalg.norm(values[:, 4:], axis=1) > 1e-6))
    moving = bool(np.any(values[:, :2]))
    return oriented and not (moving and np.all(values[:, 2:] == [0, 0, 0, 0, 0, 1]))


def _check_span(force: Stamps, odom: Stamps) -> None:
    if len(odom) < FEWEST:
        raise BagError(f'{len(odom)} odometry messages; at least {FEWEST} are needed.')
    if force[-1] < odom[0] or odom[-1] < force[0]:
        gap = (max(force[0], odom[0]) - min(force[-1], odom[-1])) / NANOSECONDS
        raise BagError(
            f'forces and odometry do not overlap in time, they are {gap:.3g} s apart. Were they '
            'stamped by different clocks? Give every node the same use_sim_time.'
        )


def _notes(
    name: str, series: Mapping[str, Series], usable: Mapping[str, Ordered], by_header: bool
) -> list[str]:
    notes = [
        f'{name}: left out {item.dropped} messages of {series[role].topic} that are not finite'
        for role, item in usable.items()
        if item.dropped
    ]
    if not by_header:
        notes.append(f'{name}: not all messages are stamped; used the times of receipt')
    return [*notes, *(f'{name}: {hole}' for hole in _holes(usable))]


def _of_standing(run: Run) -> list[str]:
    seen = turning(run)
    told = f'{run.name}: odometry turns by {seen.rate:.4f} rad/s while the robot stands'
    advice = 'identify takes that off as the bias of a gyro, nothing else does'
    return [f'{told}; {advice}'] if seen.is_told else []


def _holes(usable: Mapping[str, Ordered]) -> list[str]:
    """Tell where the odometry is silent far longer than it usually is."""
    odom = usable['odom'].stamp
    start = min(item.stamp[0] for item in usable.values())
    steps = np.diff(odom) / NANOSECONDS
    holes = np.flatnonzero(steps > max(LONGEST_SILENCE, USUAL_SILENCES * np.median(steps)))
    if not holes.size:
        return []
    times = ', '.join(
        f'{steps[i]:.1f} s from {(odom[i] - start) / NANOSECONDS:.1f} s on' for i in holes[:MOST]
    )
    more = f' and {len(holes) - MOST} more' if len(holes) > MOST else ''
    return [f'the odometry has holes: {times}{more}; what happened there is unknown']


def _seconds(stamp: Stamps, start: int) -> Array:
    seconds: Array = (stamp - start) / NANOSECONDS
    return seconds
