"""What the paper prints, taken literally: only the demonstrations of its errors use this."""

from math import exp

import numpy as np

from diffbot_sim.paper.constants import Constants
from diffbot_sim.physics.friction import friction_force
from diffbot_sim.physics.stages import Law
from diffbot_sim.records import Array


def turning_radius(right: float, left: float, half_separation: float) -> float:
    """Return R_o [m] of (3) as printed, for wheel speeds [m/s]."""
    return half_separation * (right + left) / (-right + left)


def friction(law: Law, external: float, v: float) -> float:
    """Return F_fr [N] of (13) as printed: signs, and the comparison at rest, as they stand."""
    if v > 0.0:
        return law.coulomb + law.excess * exp(-law.stribeck * v) + law.viscous * v
    if v < 0.0:
        return -law.coulomb - law.excess * exp(law.stribeck * v) - law.viscous * v
    return external if external < law.static else law.static


def stick_test(constants: Constants, forces: tuple[float, float], until: float, h: float) -> Array:
    """Drive Fig. 7 by steps of h [s]; return v_R, v_L [m/s] after each, shape (k + 1, 2).

    As the scheme has it, a resting wheel's friction balances its own traction force up to F_s,
    and a wheel whose speed changes sign is reset to 0. The signs of (13) are put right here.
    """
    robot = constants.robot
    about = robot.half_separation**2 / robot.inertia
    coupling = np.array([[1.0, 1.0], [1.0, 1.0]]) / robot.mass
    coupling += about * np.array([[1.0, -1.0], [-1.0, 1.0]])
    force, speeds = np.array(forces), np.zeros((round(until / h) + 1, 2))
    for k, v in enumerate(speeds[:-1]):
        after = v + h * coupling @ (force - friction_force(constants.friction, v, force))
        speeds[k + 1] = np.where(after * v < 0.0, 0.0, after)
    return speeds
