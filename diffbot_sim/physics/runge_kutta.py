"""One smooth step of the classical fourth-order Runge-Kutta method: the body of every `Step`."""

from math import cos, isnan, nan, sin
from typing import Any

from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.contact import LEFT, RIGHT, Modes, accelerations, sliding_reaction
from diffbot_sim.physics.instant import WHEEL_RADIUS, Inputs, Instant
from diffbot_sim.physics.stages import Motion
from diffbot_sim.physics.vector import (
    SPEED_LEFT,
    SPEED_RIGHT,
    STATE_SIZE,
    copy_state,
    motion_at,
)
from diffbot_sim.records import Array

# Where in a step the slopes are taken, and the rows that a step works in: the state, the slopes.
NODES = (0.0, 0.5, 0.5, 1.0)
WORK_ROWS = 1 + len(NODES)
# The stages of y' = -λ y disagree by λ h / 2, and the method is stable up to λ h = 2.78.
DISAGREEMENT = 1.25

# The compiled laws of a set are put in its place.
laws: Any = None


def runge_kutta(
    params: Array,
    states: Array,
    z: Array,
    modes: Modes,
    inputs: Inputs,
    time: float,
    h: float,
    work: Array,
) -> bool:
    """Leave in work[0] the state after a step of h, in the rows behind it the slopes, k1 first.

    Return whether h is short enough for the method to be stable.
    """
    probe = work[0]
    copy_state(z, probe)
    if modes[RIGHT] == 0 and modes[LEFT] == 0:
        for i in range(STATE_SIZE):
            work[1, i] = 0.0
        return True
    for stage in range(len(NODES)):
        elapsed = NODES[stage] * h
        if stage > 0:
            for i in range(STATE_SIZE):
                probe[i] = z[i] + elapsed * work[stage, i]
        at = motion_at(params, probe, time + elapsed, elapsed)
        now = laws(params, states, at, inputs, float(modes[RIGHT]), float(modes[LEFT]))
        slope = _slope(params, at, now, modes)
        for i in range(STATE_SIZE):
            work[1 + stage, i] = slope[i]
    for i in range(STATE_SIZE):
        probe[i] = z[i] + h / 6.0 * (work[1, i] + 2.0 * (work[2, i] + work[3, i]) + work[4, i])
    return _is_stable(work[1], work[2], work[3])


@compiled
def _slope(params: Array, at: Motion, now: Instant, modes: Modes) -> tuple[float, ...]:
    """Return dz/dt: eqs. (5), (7), (11) with friction (13), in the order of z."""
    right, left = accelerations(now, sliding_reaction(at, now, modes), modes)
    dx, dy = _over_ground(at)
    r = params[WHEEL_RADIUS]
    return dx, dy, at.omega, at.speed_right / r, at.speed_left / r, right, left


@compiled
def _over_ground(at: Motion) -> tuple[float, float]:
    """Return dx/dt and dy/dt; where the place is not known they are not, either."""
    if isnan(at.x):
        return nan, nan
    return at.v * cos(at.heading), at.v * sin(at.heading)


@compiled
def _is_stable(k1: Array, k2: Array, k3: Array) -> bool:
    first = abs(k2[SPEED_RIGHT] - k1[SPEED_RIGHT]) + abs(k2[SPEED_LEFT] - k1[SPEED_LEFT])
    second = abs(k3[SPEED_RIGHT] - k2[SPEED_RIGHT]) + abs(k3[SPEED_LEFT] - k2[SPEED_LEFT])
    size = abs(k1[SPEED_RIGHT]) + abs(k1[SPEED_LEFT])
    return second <= DISAGREEMENT * first + 1e-6 * size
