"""A robot whose friction sets in smoothly: many simulators take a tanh for the sign of a speed."""

import numpy as np
from scipy.integrate import solve_ivp

from diffbot_sim.physics import Model
from diffbot_sim.records import Array, Commands, Odometry, Run

SLIDES, SCRUBS = 4e-4, 0.02  # speed [m/s], yaw rate [rad/s] at which friction acts in earnest


def driven_smoothly(model: Model, drive: Commands, scrub: float, seed: int) -> Run:
    """Return a drive under Coulomb and viscous friction, seen at every command.

    scrub: friction against turning [N·m].
    """
    robot, friction = model.robot, model.friction
    law, on_wheels = friction.law(), np.array([1.0, -1.0]) * robot.half_separation

    def rates(_: float, twist: Array, pull: Array) -> Array:
        speed = twist[0] + on_wheels * twist[1]
        force = pull - law.coulomb * np.tanh(speed / SLIDES) - law.viscous * speed
        torque = on_wheels @ force - scrub * np.tanh(twist[1] / SCRUBS)
        return np.array([force.sum() / robot.mass, torque / robot.inertia])

    twists = [np.zeros(2)]
    for start, end, pull in zip(drive.time, drive.time[1:], drive.force, strict=False):
        span = solve_ivp(rates, (start, end), twists[-1], 'LSODA', args=(pull,), rtol=1e-6)
        twists.append(span.y[:, -1])
    noise = np.random.default_rng(seed).normal(size=(len(twists), 2)) * [0.001, 0.003]
    return Run('smoothed', drive, Odometry(drive.time, np.array(twists) + noise))
