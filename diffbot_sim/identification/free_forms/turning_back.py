"""How far wheels have rolled, or the robot has turned, since the motion last turned back.

Casters swivel there, gears take up their play, tyres wind up and dry friction yields before it
slides: what then acts depends on the way since, not on the speed. Where the force turns back,
gears cross their play, too, and amplifiers wait.
"""

import numpy as np

from diffbot_sim.identification.fitting.views import View
from diffbot_sim.records import Array

# Edges of spans of the way [m] and of the angle [rad] after turning back.
WAYS = ((0.0, 0.03), (0.0, 0.1), (0.0, 0.3), (0.0, 0.03, 0.1, 0.3))
ANGLES = ((0.0, 0.1), (0.0, 0.3), (0.0, 1.0), (0.0, 0.1, 0.3, 1.0))
# The same of the time after a force turned back [s].
TIMES = ((0.0, 0.05), (0.0, 0.15), (0.0, 0.5), (0.0, 0.05, 0.15, 0.5))


def rolled_since(view: View) -> Array:
    """Return the way of each wheel since it last turned back [m], shape (k, 2)."""
    return _since(view.wheel_speed, view.stretch.time)


def turned_since(view: View) -> Array:
    """Return the angle since the yaw rate last changed sign [rad], shape (k,)."""
    return _since(view.omega[:, None], view.stretch.time)[:, 0]


def driven_since(view: View) -> Array:
    """Return the time since each wheel's command last changed its sign [s], shape (k, 2)."""
    sense = _last_sense(view.force)
    return _since(sense, view.stretch.time)


def _since(speed: Array, time: Array) -> Array:
    """Return the way since a speed last took the other sign, shape (k, n); rest is no change."""
    sense = _last_sense(speed)
    begins = np.vstack([np.zeros_like(sense[:1], bool), sense[1:] != sense[:-1]])
    steps = np.diff(time, append=time[-1])[:, None] * np.abs(speed)
    way = np.cumsum(steps, axis=0) - steps
    return np.asarray(way - np.maximum.accumulate(np.where(begins, way, 0.0), axis=0))


def _last_sense(speed: Array) -> Array:
    """Return the sign of a speed; where there is none, the last one, shape (k, n)."""
    rows = np.arange(len(speed))[:, None]
    moved = np.maximum.accumulate(np.where(speed != 0.0, rows, 0), axis=0)
    return np.asarray(np.take_along_axis(np.sign(speed), moved, axis=0))
