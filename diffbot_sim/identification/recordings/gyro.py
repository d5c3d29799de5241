"""A gyro's bias, told by a robot that stands: taken off its turn rates, and off a pose of them."""

from dataclasses import replace

import numpy as np

from diffbot_sim.identification.result import Bias
from diffbot_sim.physics.kinematics import integral, path_of
from diffbot_sim.records import Array, Odometry, Run
from diffbot_sim.standing import turning

# A rate of so many standard errors is taken off: little harm if it is none after all.
SURE = 3.0
# A pose that turns within so much of the twist, as a share of the bias, was made of it.
SAME = 0.5


def unbiased(run: Run) -> Run:
    """Return a run without the turn rate that is told while the robot stands."""
    rate, error = turning(run)
    sure = abs(rate) > SURE * error
    return replace(run, odometry=_without(run.odometry, rate)) if sure else run


def bias_of(given: Run, taken: Run) -> Bias | None:
    """Return the bias that was taken off a run; None where it was taken as it is."""
    if taken is given:
        return None
    return Bias(given.name, float(given.odometry.twist[0, 1] - taken.odometry.twist[0, 1]))


def _without(seen: Odometry, rate: float) -> Odometry:
    twist = seen.twist - np.array([0.0, rate])
    pose = seen.pose
    if pose is not None and abs(_drift(seen, pose)) < SAME * abs(rate):
        pose = _turned_back(seen.time, pose, rate)
    return replace(seen, twist=twist, pose=pose)


def _drift(seen: Odometry, pose: Array) -> float:
    """Return how much faster a pose turns than the twist tells, on the mean [rad/s]."""
    told = integral(seen.time, seen.twist[:, 1])[-1]
    return float((pose[-1, 2] - pose[0, 2] - told) / (seen.time[-1] - seen.time[0]))


def _turned_back(time: Array, pose: Array, rate: float) -> Array:
    """Return the same way driven with headings that do not turn at a rate [rad/s]."""
    heading = pose[:, 2] - rate * (time - time[0])
    middle, step = 0.5 * (heading[1:] + heading[:-1]), np.diff(path_of(pose)[:, 0])[:, None]
    place = np.cumsum(step * np.column_stack([np.cos(middle), np.sin(middle)]), axis=0)
    return np.column_stack([pose[0, :2] + np.vstack([np.zeros(2), place]), heading])
