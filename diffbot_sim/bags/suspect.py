"""Recordings that can be read, and look as if something were mistaken."""

from collections.abc import Iterator, Mapping

import numpy as np

from diffbot_sim.bags.series import Ordered
from diffbot_sim.physics.kinematics import integral, path_of
from diffbot_sim.records import Array, Odometry, Run
from diffbot_sim.standing import unfilled

# Poses and twists are held against each other over so long [s], in which neither noise nor what is
# a moment late tells much. They tell of different motions if they differ by this share.
OVER, DIFFERENT = 1.0, 0.5
# A way [m] or a turn [rad] of less in that time is none.
NONE = 0.02
# It turns either way that does so as fast [rad/s] for this share of the time.
TURNING, OFTEN = 0.2, 0.05


def suspicions(usable: Mapping[str, Ordered], run: Run) -> Iterator[str]:
    """Yield a line for each thing that can hardly be meant so."""
    left, right = usable['left_force'], usable['right_force']
    if np.array_equal(left.values, right.values) and np.ptp(left.values) and _turns(run.odometry):
        yield (
            f'{left.topic} and {right.topic} hold the same forces though the robot turns; is one '
            'of them recorded twice?'
        )
    topic = usable['odom'].topic
    for share, name, moves in _apart(run.odometry):
        if share > DIFFERENT:
            yield (
                f'{name} of {topic} and what its poses {moves} differ by {share:.0%} of it; is '
                'one of them told in another frame or unit, or are there two odometries?'
            )


def _apart(odometry: Odometry) -> Iterator[tuple[float, str, str]]:
    """Yield by which share poses and twists differ over a second, and what that is of."""
    moved = _moved(odometry)
    if moved is None:
        return
    by_pose, by_twist = moved
    names = (('twist.linear.x', 'move'), ('twist.angular.z', 'turn'))
    for column, (name, moves), empty in zip((0, 1), names, unfilled(odometry), strict=True):
        size = max(_rms(by_pose[:, column]), _rms(by_twist[:, column]))
        if size > NONE and not empty:
            yield _rms(by_pose[:, column] - by_twist[:, column]) / size, name, moves


def _moved(odometry: Odometry) -> tuple[Array, Array] | None:
    """Return way and turn in each second, shape (m, 2), by poses and by twists; None without."""
    time, pose = odometry.time, odometry.pose
    if pose is None or time[-1] - time[0] < OVER:
        return None
    added = np.column_stack([integral(time, rate) for rate in odometry.twist.T])
    at = np.searchsorted(time, np.arange(time[0], time[-1], OVER))
    whole = np.diff(time[at]) < 1.5 * OVER  # across a hole twists tell nothing
    return np.diff(path_of(pose)[at], axis=0)[whole], np.diff(added[at], axis=0)[whole]


def _turns(odometry: Odometry) -> bool:
    """Say whether a robot turns either way, by more than wheels that are not quite alike do."""
    right, left = np.quantile(odometry.twist[:, 1], [OFTEN, 1.0 - OFTEN])
    return bool(right < -TURNING and left > TURNING)


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2))) if len(values) else 0.0
