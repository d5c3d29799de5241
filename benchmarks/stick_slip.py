"""The drives that judge an integrator, and the course that the independent reference takes."""

from functools import cache
from typing import NamedTuple

import numpy as np
from reference_plant import Array, ReferencePlant

from diffbot_sim.physics import Friction, Model, Robot

# B is not 0, so that the wheels feel each other through the body.
ROBOT = Robot(inertia=0.25)
GENERALIZED = Model(ROBOT)
COULOMB_VISCOUS = Model(ROBOT, Friction('coulomb_viscous'))
SECONDS, EVERY = 60, 0.1  # length of a drive, and from one comparison to the next [s]


class Course(NamedTuple):
    """Where the robot was every EVERY seconds.

    forces [N], shape (600, 2), each held for EVERY; rows: x, y, heading, v_R, v_L, shape (601, 5).
    """

    forces: Array
    rows: Array
    events: int


def stick_slip(model: Model) -> Course:
    """Drive by forces about F_s, new ones each second: wheels stick together and one by one."""
    return _course(model, -1.6, 1.6)


def rolling(model: Model) -> Course:
    """Drive by forces so far above F_s that no wheel ever stops."""
    return _course(model, 1.5, 3.0)


@cache
def _course(model: Model, low: float, high: float) -> Course:
    """Drive by random forces within these shares of F_s."""
    law, robot = model.friction.law(), model.robot
    body = robot.mass, robot.inertia, robot.half_separation
    static = law.coulomb + law.excess
    plant = ReferencePlant(*body, static, law.coulomb, law.viscous, law.stribeck)
    forces = static * np.random.default_rng(1).uniform(low, high, (SECONDS, 2))
    stamps, times = np.arange(SECONDS + 1.0), np.linspace(0.0, SECONDS, round(SECONDS / EVERY) + 1)
    return Course(
        np.repeat(forces, round(1.0 / EVERY), axis=0), *plant.drive(stamps, forces, times)
    )
