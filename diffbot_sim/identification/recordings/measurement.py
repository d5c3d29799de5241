"""Simulations told as odometry tells them: twists of the moment, or means since the last one."""

from dataclasses import replace

import numpy as np

from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.physics import simulate
from diffbot_sim.physics.embedding import embedded
from diffbot_sim.physics.kinematics import body_twist
from diffbot_sim.physics.model import Model
from diffbot_sim.physics.state import State
from diffbot_sim.records import Array, Trajectory


def simulated(
    model: Model, stretch: Stretch, time: Array, start: State, max_step: float
) -> Trajectory:
    """Simulate with a stretch's commands, and tell the twists as its odometry would.

    time [s], shape (k,): stamps; means are taken from each to the next.
    """
    motion = simulate(embedded(model), stretch.run.commands, time, start, max_step)
    twist = motion.twist.copy()
    for axis in np.flatnonzero(stretch.run.odometry.means):
        twist[:, axis] = _means(time, _way(model, motion)[:, axis], motion.twist[0, axis])
    return replace(motion, twist=twist)


def _way(model: Model, motion: Trajectory) -> Array:
    """Return way [m] and turn [rad] that the wheels tell, shape (k, 2)."""
    right, left = model.robot.wheel_radius * motion.wheel_angle.T
    return np.column_stack(body_twist(right, left, model.half_separation))


def _means(time: Array, way: Array, first: float) -> Array:
    """Return the mean rate before each stamp; before the first one as if it had changed evenly."""
    rate = np.diff(way) / np.diff(time)
    before = 2.0 * first - rate[0] if rate.size else first
    return np.append(before, rate)
