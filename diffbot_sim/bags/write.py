"""Arrays to bags: mcap that stock `ros2 bag` reads."""

from collections.abc import Iterator, Mapping
from itertools import repeat
from pathlib import Path
from typing import Any

import numpy as np

from diffbot_sim.bags.folder import Message, write_bag
from diffbot_sim.bags.messages import odometry, twist, wrench
from diffbot_sim.records import (
    CONTACT_FRAMES,
    NANOSECONDS,
    SIDES,
    Array,
    Commands,
    Run,
    Trajectory,
)


def write_run(path: str | Path, run: Run, start_ns: int = 0) -> None:
    """Write forces and odometry; run time 0 becomes start_ns [ns]. Raises BagError."""
    write_bag(
        Path(path),
        [
            *_wheels('force', run.commands.time, run.commands.force, start_ns),
            *_odometry(run.odometry.time, run.odometry.twist, run.odometry.pose, start_ns),
        ],
    )


def write_trajectory(
    path: str | Path, commands: Commands, trajectory: Trajectory, start_ns: int = 0
) -> None:
    """Write predicted odometry and frictions, and what was commanded, stamped like write_run.

    A force is what a motor was asked for, as in any recording, not what effects made of it.
    Raises BagError.
    """
    force = commands.held_at(trajectory.time)
    write_bag(
        Path(path),
        [
            *_odometry(trajectory.time, trajectory.twist, trajectory.pose, start_ns),
            *_wheels('force', trajectory.time, force, start_ns),
            *_wheels('friction', trajectory.time, trajectory.friction, start_ns),
        ],
    )


def write_series(
    path: str | Path, series: Mapping[str, tuple[Array, Array]], start_ns: int = 0
) -> None:
    """Write plain series for plotting, stamped like write_run. Raises BagError.

    series: topic to times [s], shape (k,), and values, shape (k, 2). A topic ending in /twist
    holds v [m/s] and ω [rad/s], one ending in /wrench holds force [N] and torque [N·m].
    """
    messages = [
        Message(stamp, topic, _pair(topic, stamp, *row))
        for topic, (times, values) in series.items()
        for stamp, row in zip(_stamps(times, start_ns), values.tolist(), strict=True)
    ]
    write_bag(Path(path), messages)


def _pair(topic: str, stamp: int, first: float, second: float) -> Any:
    if topic.endswith('/twist'):
        return twist(stamp, first, second)
    return wrench(stamp, 'base_link', first, second)


def _wheels(what: str, times: Array, values: Array, start_ns: int) -> Iterator[Message]:
    for side, column in zip(SIDES, values.T.tolist(), strict=True):
        frame = CONTACT_FRAMES[side]
        for stamp, value in zip(_stamps(times, start_ns), column, strict=True):
            yield Message(stamp, f'/{side}_wheel/{what}', wrench(stamp, frame, value))


def _odometry(times: Array, motion: Array, pose: Array | None, start_ns: int) -> Iterator[Message]:
    places = repeat(None, len(times)) if pose is None else pose
    for stamp, moves, place in zip(_stamps(times, start_ns), motion, places, strict=True):
        yield Message(stamp, '/odom', odometry(stamp, moves, place))


def _stamps(times: Array, start_ns: int) -> list[int]:
    stamps: list[int] = (start_ns + np.rint(times * NANOSECONDS).astype(np.int64)).tolist()
    return stamps
