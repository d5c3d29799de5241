"""When wheels start to roll, and how long they had rested: friction may grow while they rest."""

from functools import partial

import numpy as np

from diffbot_sim.identification.fitting.views import View
from diffbot_sim.records import Array

# Slower is at rest [m/s]: what sticks is still but for rounding. A wheel that breaks away early or
# late is told by its speed for so long [s]. On a rough floor a wheel may stop for less than this.
STILL, START, STUMBLE = 1e-9, 0.4, 0.2
# Long before any run [s].
NEVER = -1e9


def rest_before(view: View) -> Array:
    """Return for how long each wheel rested, the last time, as ln of seconds, shape (k, 2)."""
    began, ended = _last_rest(view)
    return np.log(np.maximum(ended - began, STUMBLE))


def started(view: View) -> Array:
    """Return the direction of wheels that rested and have just started, else 0, shape (k, 2)."""
    began, ended = _last_rest(view)
    fresh = view.stretch.time[:, None] - ended <= START
    return np.where(fresh & (ended - began >= STUMBLE), np.sign(view.wheel_speed), 0.0)


def _last_rest(view: View) -> tuple[Array, Array]:
    """Return when the last rest of each wheel began, and until when it has lasted [s]."""
    still = np.abs(view.wheel_speed) <= STILL
    begins = still & ~np.vstack([np.zeros((1, 2), bool), still[:-1]])
    time = view.stretch.time[:, None]
    latest = partial(np.maximum.accumulate, axis=0)
    return latest(np.where(begins, time, NEVER)), latest(np.where(still, time, NEVER))
