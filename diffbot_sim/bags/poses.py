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


def without_broken(series: Series) -> tuple[Series, bool]:
    """Return odometry with empty poses where too many are not finite, and whether that is so.

    Their twists may serve all the same.
    """
    broken = ~np.isfinite(series.values[:, POSE]).all(axis=1)
    if np.mean(broken) <= MOST_UNUSABLE:
        return series, False
    values = series.values.copy()
    values[:, POSE] = 0.0
    return replace(series, values=values), True


def pose_of(odom: Ordered, time: Array) -> Array | None:
    """Return x, y [m] and yaw [rad], unwrapped, shape (k, 3), or None where nobody filled them."""
    if not _is_oriented(odom.values):
        return None
    heading = np.unwrap(yaw(odom.values[:, ORIENTATION]))
    if np.ptp(heading) == 0.0 and (_is_at_origin(odom.values) or _turns(odom.values, time)):
        return None
    return np.column_stack([odom.values[:, 2:4], heading])


def is_half_filled(odom: Ordered, time: Array) -> bool:
    """Say whether poses move, but never turn, though the twists do."""
    filled = _is_oriented(odom.values) and not _is_at_origin(odom.values)
    return filled and pose_of(odom, time) is None


def _is_oriented(values: Array) -> bool:
    return bool(np.all(np.linalg.norm(values[:, ORIENTATION], axis=1) > 1e-6))


def _is_at_origin(values: Array) -> bool:
    """Say whether poses stay at the origin while the twists move."""
    moving = bool(np.any(values[:, TWIST]))
    return moving and bool(np.all(values[:, POSE] == [0, 0, 0, 0, 0, 1]))


def _turns(values: Array, time: Array) -> bool:
    turned = np.cumsum(values[1:, 1] * np.diff(time))
    return bool(np.ptp(turned) > TURNED)
