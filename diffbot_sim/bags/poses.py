"""Poses of odometry: where somebody filled them."""

from dataclasses import replace

import numpy as np

from diffbot_sim.bags.messages import yaw
from diffbot_sim.bags.series import MOST_UNUSABLE, Ordered, Series
from diffbot_sim.records import Array

# Columns of odometry: the twist, and the pose with its orientation.
TWIST, POSE, ORIENTATION = slice(0, 2), slice(2, 8), slice(4, 8)
# A yaw that stays the same while the twists turn so far [rad] was not measured.
TURNED = 0.5


def without_broken(series: Series) -> Series:
    """Return odometry, with empty poses where too many are not finite: its twists may serve."""
    broken = ~np.isfinite(series.values[:, POSE]).all(axis=1)
    if np.mean(broken) <= MOST_UNUSABLE:
        return series
    values = series.values.copy()
    values[:, POSE] = 0.0
    return replace(series, values=values)


def pose_of(odom: Ordered, time: Array) -> Array | None:
    """Return x, y [m] and yaw [rad], unwrapped, shape (k, 3), or None where nobody filled them."""
    if not _is_oriented(odom.values):
        return None
    heading = np.unwrap(yaw(odom.values[:, ORIENTATION]))
    if np.ptp(heading) == 0.0 and (_is_at_origin(odom.values) or _turns(odom.values, time)):
        return None
    return np.column_stack([odom.values[:, 2:4], heading])


def is_filled(odom: Ordered) -> bool:
    """Say whether somebody filled the poses, whatever they are worth."""
    return _is_oriented(odom.values) and not _is_at_origin(odom.values)


def _is_oriented(values: Array) -> bool:
    return bool(np.all(np.linalg.norm(values[:, ORIENTATION], axis=1) > 1e-6))


def _is_at_origin(values: Array) -> bool:
    """Say whether poses stay at the origin while the twists move."""
    moving = bool(np.any(values[:, TWIST]))
    return moving and bool(np.all(values[:, POSE] == [0, 0, 0, 0, 0, 1]))


def _turns(values: Array, time: Array) -> bool:
    turned = np.cumsum(values[1:, 1] * np.diff(time))
    return bool(np.ptp(turned) > TURNED)
