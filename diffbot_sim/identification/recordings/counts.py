"""Twists that are whole counts of encoders: means since the sample before, beyond doubt.

The counts of both wheels in an interval add up to its way and differ by its turn: each is a whole
number of the smallest there is, and both are even or both odd. Numbers that were only rounded are
not. Counts over another time than the interval do not add up to the pose.
"""

import numpy as np

from diffbot_sim.physics.kinematics import path_of
from diffbot_sim.records import Array, Odometry

# Of a count, how far a step may be from a whole number of them.
CLOSE = 0.1
# The share of steps that must be whole, and how many of them must be odd, for parity to tell.
MOST, ODD = 0.95, 0.2
# Steps by which this is known, and numbers less than this share of the largest that are none.
FEWEST, NOTHING = 100, 1e-5


def is_counted(odometry: Odometry) -> bool:
    """Say whether twists are whole counts since the sample before, which the pose adds up."""
    if odometry.pose is None:
        return False
    steps = odometry.twist[1:] * np.diff(odometry.time)[:, None]
    count = np.array([_least(of_one) for of_one in steps.T])
    numbers = np.round(steps / count)
    moving = np.any(numbers != 0.0, axis=1)
    if np.count_nonzero(moving) < FEWEST:
        return False
    moved = np.diff(path_of(odometry.pose), axis=0)
    whole = (np.abs(told - numbers * count) < CLOSE * count for told in (steps, moved))
    odd = numbers % 2 == 1
    counted = np.all([np.all(it, axis=1) for it in whole], axis=0) & (odd[:, 0] == odd[:, 1])
    return bool(np.mean(counted[moving]) > MOST and np.all(np.mean(odd[moving], axis=0) > ODD))


def _least(steps: Array) -> float:
    """Return the number of which all steps may be multiples: the least difference of any two."""
    size = np.unique(np.abs(steps))
    apart = np.diff(size)
    least = np.min(apart[apart > NOTHING * size[-1]], initial=size[-1] or 1.0)
    # All of them tell it better than two.
    numbers = np.round(size / least)
    return float(size @ numbers / max(numbers @ numbers, 1.0)) or 1.0
