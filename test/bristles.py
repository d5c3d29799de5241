"""A robot whose wheels yield like bristles before they slide: the LuGre model of friction.

Canudas de Wit, Olsson, Åström, Lischinsky: A new model for control of systems with friction, 1995.
"""

import numpy as np

from diffbot_sim.physics import Friction, Model, Robot
from diffbot_sim.records import Array, Commands, Odometry, Run

STEP, EVERY = 5e-4, 40  # [s], steps from one sample to the next
STIFFNESS, DAMPING = 500.0, 5.0  # of a wheel's bristles [N/m], [N·s/m]


def driven_on_bristles(model: Model, drive: Commands, seed: int) -> Run:
    """Return a drive on bristles whose steady friction is the declared one, at 50 Hz."""
    robot, friction = model.robot, model.friction
    steps = round(drive.time[-1] / STEP)
    force = drive.force[np.searchsorted(drive.time, np.arange(steps) * STEP, 'right') - 1]
    twist = moved(robot, friction, force)[::EVERY]
    seen = np.arange(len(twist)) * EVERY * STEP
    noise = np.random.default_rng(seed).normal(size=twist.shape) * [0.001, 0.003]
    return Run('bristles', drive, Odometry(seen, twist + noise))


def moved(robot: Robot, friction: Friction, force: Array) -> Array:
    """Return the twist at every step under forces on the right and the left wheel."""
    coulomb, static, viscous = (
        friction.normal_force * mu
        for mu in (friction.mu_coulomb, friction.mu_static, friction.mu_viscous)
    )
    on_body = np.array([[1.0, 1.0], [1.0, -1.0]]) * [[1.0], [robot.half_separation]]
    speed, bent, twists = np.zeros(2), np.zeros(2), [np.zeros(2)]
    for pull in force[1:]:
        most = coulomb + (static - coulomb) * np.exp(-friction.stribeck * np.abs(speed))
        bending = speed - STIFFNESS * np.abs(speed) / most * bent
        rubbing = STIFFNESS * bent + DAMPING * bending + viscous * speed
        bent = bent + STEP * bending
        change = on_body @ (pull - rubbing) / [robot.mass, robot.inertia]
        twists.append(twists[-1] + STEP * change)
        speed = twists[-1] @ [[1.0, 1.0], [robot.half_separation, -robot.half_separation]]
    return np.array(twists)
