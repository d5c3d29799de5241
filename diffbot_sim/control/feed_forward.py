"""What a model says it takes to move as wanted, before any error shows: eqs. (7), (11), (13)."""

import numpy as np

from diffbot_sim.physics import Friction, Robot
from diffbot_sim.physics.friction import friction_force
from diffbot_sim.physics.kinematics import wheel_speeds
from diffbot_sim.records import Array, Pair


def wheel_forces(robot: Robot, friction: Friction, twist: Pair, acceleration: Pair) -> Pair:
    """Return the forces [N] of the right and left wheel for a steady twist and its change.

    twist: v [m/s], ω [rad/s]; acceleration: their derivatives [m/s², rad/s²].
    """
    b = robot.half_separation
    along = 0.5 * robot.mass * acceleration[0]
    around = 0.5 * robot.inertia * acceleration[1] / b
    speeds: Array = np.array(wheel_speeds(*twist, b))
    right, left = friction_force(friction, speeds, np.zeros(2)).tolist()
    return right + along + around, left + along - around
