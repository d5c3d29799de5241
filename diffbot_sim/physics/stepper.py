"""Fourth-order Runge-Kutta between events; stops and breakaways are located inside the step.

While no contact changes between sticking and sliding the flow is smooth, and one classical
step is taken. A step in which a wheel (or dry yaw friction) reaches speed 0, or a stuck contact
exceeds its limit, is cut at that moment; so the method's order holds through stick-slip motion.
"""

from math import inf

import numpy as np

from diffbot_sim.physics import contact
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.contact import FREE, LEFT, RIGHT, YAW, Modes
from diffbot_sim.physics.dynamics import Dynamics, Laws
from diffbot_sim.physics.instant import Inputs
from diffbot_sim.physics.vector import (
    SPEED_LEFT,
    SPEED_RIGHT,
    copy_state,
    motion_at,
)
from diffbot_sim.records import Array

# An event is placed to this fraction of the step.
LOCATION = 1e-11
# Events in one step beyond this many are grazing contacts; they are left to stick.
MOST_EVENTS = 64
# A step is halved while its stages disagree, for there the method is unstable; at most to this
# share of it: a live robot must never wait for its friction.
SHORTEST_SHARE = 2.0**-12


@compiled
def advance(
    dynamics: Dynamics,
    params: Array,
    states: Array,
    z: Array,
    modes: Modes,
    inputs: Inputs,
    time: float,
    duration: float,
    work: Array,
) -> None:
    """Move z, modes and effect states on by one step under constant inputs, events included."""
    done, events, longest, shortest = 0.0, 0, duration, duration * SHORTEST_SHARE
    while done < duration:
        held = events < MOST_EVENTS and update_contacts(
            dynamics.laws, params, states, z, modes, inputs, time + done
        )
        left = duration - done
        span = min(left, longest)
        taken, event = _step_to_event(
            dynamics, params, states, z, modes, inputs, time + done, span, shortest, work, held
        )
        if len(states) > 0:
            dynamics.settle(params, states, motion_at(params, z, time + done, taken), inputs)
        copy_state(work[0], z)
        if event:
            contact.arrive(z, modes)
            events += 1
        # What was too long a moment ago is not tried again at once.
        longest = duration if event else 2.0 * taken
        done = duration if taken == left else done + taken


@compiled
def advance_through(
    dynamics: Dynamics,
    params: Array,
    states: Array,
    z: Array,
    modes: Modes,
    inputs: Inputs,
    time: float,
    duration: float,
    max_step: float,
    work: Array,
) -> None:
    """Advance under constant inputs, in equal steps of at most max_step [s]."""
    count = max(1, int(np.ceil(duration / max_step - 1e-6)))
    step = duration / count
    for i in range(count):
        advance(dynamics, params, states, z, modes, inputs, time + i * step, step, work)


@compiled
def update_contacts(
    laws: Laws,
    params: Array,
    states: Array,
    z: Array,
    modes: Modes,
    inputs: Inputs,
    time: float,
) -> bool:
    """Release what the present inputs tear loose; tell whether all stuck contacts now hold."""
    if modes[RIGHT] != 0 and modes[LEFT] != 0 and modes[YAW] != 0:
        return True
    at = motion_at(params, z, time, 0.0)
    for _ in range(4):
        if contact.slack(laws, params, states, at, inputs, modes) >= 0.0:
            return True
        if not contact.release(laws, params, states, at, inputs, modes):
            return False
    return False


@compiled
def _step_to_event(
    dynamics: Dynamics,
    params: Array,
    states: Array,
    z: Array,
    modes: Modes,
    inputs: Inputs,
    time: float,
    duration: float,
    shortest: float,
    work: Array,
    held: bool,
) -> tuple[float, bool]:
    """Leave in work[0] the state after the step, or at its first event; return (taken, event)."""
    step = _stable_step(dynamics, params, states, z, modes, inputs, time, duration, shortest, work)
    if step == 0.0:
        return duration, False
    after = _margin(dynamics.laws, params, states, work[0], modes, inputs, time, step, held)
    if after >= 0.0:
        high = _turning_point(z, work, modes, step)
        if high >= step:
            return step, False
        dynamics.step(params, states, z, modes, inputs, time, high, work)
        after = _margin(dynamics.laws, params, states, work[0], modes, inputs, time, high, held)
        if after >= 0.0:
            dynamics.step(params, states, z, modes, inputs, time, step, work)
            return step, False
        step = high
    event = _locate(dynamics, params, states, z, modes, inputs, time, step, work, held, after)
    dynamics.step(params, states, z, modes, inputs, time, event, work)
    return event, True


@compiled
def _stable_step(
    dynamics: Dynamics,
    params: Array,
    states: Array,
    z: Array,
    modes: Modes,
    inputs: Inputs,
    time: float,
    duration: float,
    shortest: float,
    work: Array,
) -> float:
    """Take the longest stable step that halving the duration gives; return it.

    Where the shortest is not stable all stays as it is, and 0 is returned: an unstable step would
    add energy.
    """
    step = duration
    while not dynamics.step(params, states, z, modes, inputs, time, step, work):
        step *= 0.5
        if step < shortest:
            copy_state(z, work[0])
            return 0.0
    return step


@compiled
def _locate(
    dynamics: Dynamics,
    params: Array,
    states: Array,
    z: Array,
    modes: Modes,
    inputs: Inputs,
    time: float,
    high: float,
    work: Array,
    held: bool,
    after: float,
) -> float:
    """Return the length of the step that ends just past the event; high and after bound it.

    Illinois variant of regula falsi; halving where the secant does not help.
    """
    low, side, precision = 0.0, 0, LOCATION * high
    before = max(_margin(dynamics.laws, params, states, z, modes, inputs, time, 0.0, held), 0.0)
    while high - low > precision:
        trial = high - after * (high - low) / (after - before)
        if not low < trial < high:
            trial = 0.5 * (low + high)
        dynamics.step(params, states, z, modes, inputs, time, trial, work)
        value = _margin(dynamics.laws, params, states, work[0], modes, inputs, time, trial, held)
        if value >= 0.0:
            low, before = trial, value
            after = 0.5 * after if side > 0 else after
            side = 1
        else:  # nan too: a stage overshot so far that (13) overflowed
            high, after = trial, value
            before = 0.5 * before if side < 0 else before
            side = -1
    return high


@compiled
def _margin(
    laws: Laws,
    params: Array,
    states: Array,
    z: Array,
    modes: Modes,
    inputs: Inputs,
    time: float,
    elapsed: float,
    held: bool,
) -> float:
    """Return how far the contacts are from changing: negative once one has."""
    margin = inf
    if modes[RIGHT] != 0:
        margin = modes[RIGHT] * z[SPEED_RIGHT]
    if modes[LEFT] != 0:
        margin = min(margin, modes[LEFT] * z[SPEED_LEFT])
    if abs(modes[YAW]) == 1:
        margin = min(margin, modes[YAW] * (z[SPEED_RIGHT] - z[SPEED_LEFT]))
    if held and (modes[RIGHT] == 0 or modes[LEFT] == 0 or modes[YAW] == 0):
        at = motion_at(params, z, time + elapsed, elapsed)
        margin = min(margin, contact.slack(laws, params, states, at, inputs, modes))
    return margin


@compiled
def _turning_point(z: Array, work: Array, modes: Modes, duration: float) -> float:
    """Return when a contact may have touched speed 0 and come back within the step.

    Judged by the parabola through both ends and the first slope; duration where there is none.
    """
    earliest = duration
    for index, mode in enumerate(modes):
        if mode == FREE:
            continue
        if index == YAW:
            begin = mode * (z[SPEED_RIGHT] - z[SPEED_LEFT])
            slope = mode * (work[1, SPEED_RIGHT] - work[1, SPEED_LEFT])
            end = mode * (work[0, SPEED_RIGHT] - work[0, SPEED_LEFT])
        else:
            wheel = SPEED_RIGHT + index
            begin, slope, end = mode * z[wheel], mode * work[1, wheel], mode * work[0, wheel]
        bend = (end - begin - slope * duration) / duration**2
        if begin > 0.0 > slope and bend > 0.0 and begin < slope * slope / (4.0 * bend):
            earliest = min(earliest, -0.5 * slope / bend)
    return earliest
