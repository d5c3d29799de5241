"""A change of speed from outside, as a measurement makes it: what sticks stays."""

import numpy as np

from diffbot_sim.physics import contact
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.contact import FREE, LEFT, RIGHT, YAW, Modes
from diffbot_sim.physics.vector import SPEED_LEFT, SPEED_RIGHT
from diffbot_sim.records import Array


@compiled
def correct(z: Array, modes: Modes, b: float, v: float, omega: float) -> None:
    """Change the speed of what slides by v [m/s] and omega [rad/s]; no wheel goes through zero.

    Turning may: dry friction against it soon stops it, and the slighter that is the later, so that
    friction that vanishes leaves the motion without it.
    """
    if modes[YAW] == 0:
        omega = 0.0
    if modes[RIGHT] != 0:
        z[SPEED_RIGHT] += v + b * omega
    if modes[LEFT] != 0:
        z[SPEED_LEFT] += v - b * omega
    contact.stop_wheels(z, modes)
    if modes[YAW] != FREE:
        modes[YAW] = np.sign(z[SPEED_RIGHT] - z[SPEED_LEFT])


@compiled
def put(z: Array, modes: Modes, b: float, v: float, omega: float) -> None:
    """Change the speed of both wheels by v [m/s] and omega [rad/s], whatever they did before."""
    z[SPEED_RIGHT] += v + b * omega
    z[SPEED_LEFT] += v - b * omega
    contact.modes_of(z, 0.0 if modes[YAW] == FREE else 1.0, modes)
