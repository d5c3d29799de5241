"""Frozen records that travel between the rooms. SI units; wheel columns are [right, left]."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Pair = tuple[float, float]
# The wheels in the order of columns.
SIDES = ('right', 'left')
# The frames that forces on the wheels are told in: where each touches the floor.
CONTACT_FRAMES = {side: f'{side}_wheel_contact' for side in SIDES}
# In a second: stamps of bags and messages are whole numbers of them.
NANOSECONDS = 1_000_000_000
# No force [N], speed [m/s] or turn rate [rad/s] of a robot is larger.
LARGEST = 1e6


def held(since: Array | NDArray[np.int64], values: Array, at: Array | NDArray[np.int64]) -> Array:
    """Return values at other times, shape (k, m), each held until the next, 0 before all."""
    index = np.searchsorted(since, at, side='right') - 1
    return np.where(index[:, None] >= 0, values[index], 0.0)


@dataclass(frozen=True)
class Commands:
    """Wheel force commands, each held until the next one.

    time: stamps [s], shape (n,), increasing.
    force: traction forces [N], shape (n, 2), columns right and left.
    unsure: the variance that messages which were lost add to the impulse of each force for each
    second [N²·s], shape (n, 2); None where none were.
    """

    time: Array
    force: Array
    unsure: Array | None = None

    def held_at(self, time: Array) -> Array:
        """Return the forces in force at times [s], shape (k, 2): none before the first command."""
        return held(self.time, self.force, time)

    def rows(self, which: NDArray[np.int64] | NDArray[np.bool_]) -> 'Commands':
        """Return some of the commands."""
        unsure = None if self.unsure is None else self.unsure[which]
        return Commands(self.time[which], self.force[which], unsure)


@dataclass(frozen=True)
class Odometry:
    """Measured motion.

    time: stamps [s], shape (k,), increasing.
    twist: linear [m/s] and angular [rad/s] velocity, shape (k, 2).
    pose: x [m], y [m], yaw [rad, unwrapped], shape (k, 3); None where none was recorded.
    means: whether v and ω are means since the sample before, as counted ways give them.
    """

    time: Array
    twist: Array
    pose: Array | None = None
    means: tuple[bool, bool] = (False, False)


@dataclass(frozen=True)
class Run:
    """One drive of one robot: what was commanded and what was measured.

    rolled: way [m] and turn [rad] since its wheels stood at angle 0, where it begins.
    """

    name: str
    commands: Commands
    odometry: Odometry
    rolled: tuple[float, float] = (0.0, 0.0)


@dataclass(frozen=True)
class Trajectory:
    """A simulated motion at given stamps.

    time [s], shape (k,); twist [m/s, rad/s], pose [m, m, rad], wheel_angle [rad],
    wheel_speed [m/s], traction and friction [N]: one row each stamp, wheels right then left.
    friction is positive where it opposes forward motion: F_fr of eq. (13).
    """

    time: Array
    twist: Array
    pose: Array
    wheel_angle: Array
    wheel_speed: Array
    traction: Array
    friction: Array
