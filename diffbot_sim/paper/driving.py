"""Robots pushed by prescribed forces, the same on many experiments."""

import numpy as np

from diffbot_sim.physics import Model, simulate
from diffbot_sim.physics.state import State
from diffbot_sim.records import Commands, Trajectory

# A force from a moment on: time [s], on the right and on the left wheel [N].
Push = tuple[float, float, float]


def drive(
    model: Model,
    *pushes: Push,
    until: float,
    every: float = 0.01,
    start: State | None = None,
) -> Trajectory:
    """Return the motion from time 0 to `until` [s], a row `every` so many seconds."""
    time, *forces = np.array(pushes).T
    count = round(until / every) + 1
    stamps = np.linspace(0.0, until, count)
    return simulate(model, Commands(time, np.column_stack(forces)), stamps, start)
