"""Dry contacts of the robot: two wheels and turning. Which stick, which slide, with what force.

Friction is set-valued at speed 0, so each contact has a mode: 0 sticks, +1 or -1 slides that way.
All contacts are resolved together, since a stuck wheel carries what reaches it through the body:
with A = 1/m + b²/J, the reaction of a stuck left wheel is not F_L but F_L + (B/A) n_R.
"""

from math import exp, inf
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.dynamics import Laws
from diffbot_sim.physics.instant import Inputs, Instant
from diffbot_sim.physics.stages import Motion
from diffbot_sim.physics.vector import SPEED_LEFT, SPEED_RIGHT, evaluate
from diffbot_sim.records import Array

Modes = NDArray[np.int64]
RIGHT, LEFT, YAW = range(3)
# The mode of turning where there is no dry yaw friction: neither sticks nor has a limit.
FREE = 2
# A contact holds up to its limit and this share of the forces that balance in it, so that rounding
# never tears it loose: whatever breaks away is then sure to accelerate.
ROUNDING = 1e-14
# The Stribeck curve is continued past speed 0, where stages of a step may look, up to this power.
STEEPEST = 1.0


class Reaction(NamedTuple):
    """Friction of the wheels [N, positive opposes forward motion] and of turning [N·m]."""

    right: float
    left: float
    yaw: float


class Range(NamedTuple):
    """What each contact, at rest, allows f_R - f_L to be [N]."""

    right_low: float
    right_high: float
    left_low: float
    left_high: float
    yaw_low: float
    yaw_high: float


@compiled
def instant_at(
    laws: Laws, params: Array, states: Array, at: Motion, inputs: Inputs, modes: Modes
) -> Instant:
    """Evaluate the forces for wheels that roll as their modes say."""
    return evaluate(laws, params, states, at, inputs, float(modes[RIGHT]), float(modes[LEFT]))


@compiled
def sliding_reaction(at: Motion, now: Instant, modes: Modes) -> Reaction:
    """Return the friction forces while at least one wheel rolls: (13), and what sticking takes."""
    right, left, yaw = 0.0, 0.0, modes[YAW] * now.dry_torque
    if modes[RIGHT] != 0:
        drop = now.excess_right, now.stribeck_right
        right = _sliding(modes[RIGHT], at.speed_right, now.coulomb_right, drop, now.viscous_right)
    if modes[LEFT] != 0:
        drop = now.excess_left, now.stribeck_left
        left = _sliding(modes[LEFT], at.speed_left, now.coulomb_left, drop, now.viscous_left)
    b, mass, inertia = now.b, now.mass, now.inertia
    mobility = 1.0 / mass + b * b / inertia
    if modes[RIGHT] == 0:
        spin = b * (now.torque + b * left - yaw) / inertia
        right = ((now.force - left) / mass + spin) / mobility
    elif modes[LEFT] == 0:
        spin = b * (now.torque - b * right - yaw) / inertia
        left = ((now.force - right) / mass - spin) / mobility
    elif modes[YAW] == 0:
        yaw = now.torque - b * (right - left)
    return Reaction(right, left, yaw)


@compiled
def _sliding(
    mode: int, speed: float, coulomb: float, drop: tuple[float, float], viscous: float
) -> float:
    """Return (13) for a wheel that rolls as its mode says; drop: Stribeck excess and rate."""
    excess, rate = drop
    along = mode * speed
    size = coulomb + excess * exp(min(-rate * along, STEEPEST))
    return mode * (size + viscous * along)


@compiled
def accelerations(now: Instant, reaction: Reaction, modes: Modes) -> tuple[float, float]:
    """Return dv_R/dt and dv_L/dt [m/s²], exactly 0.0 for a wheel that sticks."""
    along = (now.force - (reaction.right + reaction.left)) / now.mass
    if modes[YAW] == 0:
        return along, along
    difference = reaction.right - reaction.left
    about = now.b * ((now.torque - now.b * difference - reaction.yaw) / now.inertia)
    right = 0.0 if modes[RIGHT] == 0 else along + about
    left = 0.0 if modes[LEFT] == 0 else along - about
    return right, left


@compiled
def reaction_at(
    laws: Laws, params: Array, states: Array, at: Motion, inputs: Inputs, modes: Modes
) -> Reaction:
    """Return the friction forces of any pattern of sticking and sliding."""
    if modes[RIGHT] == 0 and modes[LEFT] == 0:
        return _reaction_at_rest(laws, params, states, at, inputs)
    return sliding_reaction(at, instant_at(laws, params, states, at, inputs, modes), modes)


@compiled
def slack(
    laws: Laws, params: Array, states: Array, at: Motion, inputs: Inputs, modes: Modes
) -> float:
    """Return how far the stuck contacts are from breaking away; negative: they must."""
    if modes[RIGHT] != 0 and modes[LEFT] != 0 and modes[YAW] != 0:
        return inf
    if modes[RIGHT] == 0 and modes[LEFT] == 0:
        now = _pushed_forward(laws, params, states, at, inputs)
        rest = _rest_range(laws, params, states, at, inputs, now)
        low, high = _wheels(rest)
        return _allowance(now) + min(high - rest.yaw_low, rest.yaw_high - low, high - low)
    now = instant_at(laws, params, states, at, inputs, modes)
    reaction = sliding_reaction(at, now, modes)
    right, left = float(modes[RIGHT]), float(modes[LEFT])
    allowance = _allowance(now) + ROUNDING * (abs(reaction.right) + abs(reaction.left))
    if modes[RIGHT] == 0:
        pushed = evaluate(laws, params, states, at, inputs, _direction(reaction.right), left)
        return pushed.static_right - abs(reaction.right) + allowance
    if modes[LEFT] == 0:
        pushed = evaluate(laws, params, states, at, inputs, right, _direction(reaction.left))
        return pushed.static_left - abs(reaction.left) + allowance
    return now.dry_torque - abs(reaction.yaw) + now.b * allowance


@compiled
def release(
    laws: Laws, params: Array, states: Array, at: Motion, inputs: Inputs, modes: Modes
) -> bool:
    """Let the contacts slide whose limit is exceeded; tell whether anything changed."""
    if modes[RIGHT] == 0 and modes[LEFT] == 0:
        return _break_rest(laws, params, states, at, inputs, modes)
    reaction = sliding_reaction(at, instant_at(laws, params, states, at, inputs, modes), modes)
    if modes[RIGHT] == 0:
        modes[RIGHT] = np.sign(reaction.right)
    elif modes[LEFT] == 0:
        modes[LEFT] = np.sign(reaction.left)
    else:
        modes[YAW] = np.sign(reaction.yaw)
    return True


@compiled
def arrive(z: Array, modes: Modes) -> None:
    """Stop, exactly, the contacts that have reached speed 0 or just passed it."""
    yaw = abs(modes[YAW]) == 1 and modes[YAW] * (z[SPEED_RIGHT] - z[SPEED_LEFT]) <= 0.0
    if not stop_wheels(z, modes) and yaw:
        common = 0.5 * (z[SPEED_RIGHT] + z[SPEED_LEFT])
        z[SPEED_RIGHT], z[SPEED_LEFT], modes[YAW] = common, common, 0


@compiled
def stop_wheels(z: Array, modes: Modes) -> bool:
    """Stop the wheels that have reached speed 0 or passed it; tell whether one has."""
    right = modes[RIGHT] != 0 and modes[RIGHT] * z[SPEED_RIGHT] <= 0.0
    left = modes[LEFT] != 0 and modes[LEFT] * z[SPEED_LEFT] <= 0.0
    if right:
        z[SPEED_RIGHT], modes[RIGHT] = 0.0, 0
    if left:
        z[SPEED_LEFT], modes[LEFT] = 0.0, 0
    return right or left


@compiled
def modes_of(z: Array, dry_torque: float, modes: Modes) -> None:
    """Set the modes that speeds imply: what stands still is taken to stick."""
    modes[RIGHT] = np.sign(z[SPEED_RIGHT])
    modes[LEFT] = np.sign(z[SPEED_LEFT])
    turning = np.sign(z[SPEED_RIGHT] - z[SPEED_LEFT])
    modes[YAW] = turning if dry_torque > 0.0 else FREE


@compiled
def _allowance(now: Instant) -> float:
    """Return what rounding may add to a reaction [N]."""
    return ROUNDING * (abs(now.force) + (abs(now.torque) + now.dry_torque) / now.b)


@compiled
def _direction(towards: float) -> float:
    return 1.0 if towards >= 0.0 else -1.0


@compiled
def _pushed_forward(
    laws: Laws, params: Array, states: Array, at: Motion, inputs: Inputs
) -> Instant:
    """Evaluate the forces at rest; only friction depends on which way the wheels are pushed."""
    return evaluate(laws, params, states, at, inputs, 1.0, 1.0)


@compiled
def _rest_range(
    laws: Laws, params: Array, states: Array, at: Motion, inputs: Inputs, forward: Instant
) -> Range:
    """Return what the contacts allow, pushed either way; forward: what bears on them that way."""
    backward = evaluate(laws, params, states, at, inputs, -1.0, -1.0)
    force, torque, dry_torque = forward.force, forward.torque, forward.dry_torque
    return Range(
        -2.0 * backward.static_right - force,
        2.0 * forward.static_right - force,
        force - 2.0 * forward.static_left,
        force + 2.0 * backward.static_left,
        (torque - dry_torque) / forward.b,
        (torque + dry_torque) / forward.b,
    )


@compiled
def _wheels(rest: Range) -> tuple[float, float]:
    """Return the ends of what both wheels allow; low exceeds high where nothing suits both."""
    return max(rest.right_low, rest.left_low), min(rest.right_high, rest.left_high)


@compiled
def _reaction_at_rest(
    laws: Laws, params: Array, states: Array, at: Motion, inputs: Inputs
) -> Reaction:
    """Share a resting robot's torque between wheels and yaw friction in the ratio of their limits.

    Three dry contacts hold two motions, so the split is a choice wherever yaw friction exists.
    """
    now = _pushed_forward(laws, params, states, at, inputs)
    rest = _rest_range(laws, params, states, at, inputs, now)
    wheels_low, wheels_high = _wheels(rest)
    wheels, yaw = wheels_high - wheels_low, rest.yaw_high - rest.yaw_low
    share = wheels / (wheels + yaw) if yaw > 0.0 and wheels > 0.0 else 1.0
    low, high = max(wheels_low, rest.yaw_low), min(wheels_high, rest.yaw_high)
    difference = min(max(share * now.torque / now.b, low), high)
    if high < low:  # by less than the allowance
        difference = 0.5 * (low + high)
    right = 0.5 * (now.force + difference)
    left = 0.5 * (now.force - difference)
    return Reaction(right, left, now.torque - now.b * difference)


@compiled
def _break_rest(
    laws: Laws, params: Array, states: Array, at: Motion, inputs: Inputs, modes: Modes
) -> bool:
    """Find how a resting robot starts to move: the one pattern whose motion agrees with itself.

    Dry friction is maximally dissipative, so the pattern exists and is unique but for ties, as
    long as friction does not drop when sliding starts. Where it does (coulomb_stiction), a wheel
    that cannot rest slides, and any other contact stays stuck where it can.
    """
    now = _pushed_forward(laws, params, states, at, inputs)
    torn_right, torn_left = _torn(
        _rest_range(laws, params, states, at, inputs, now), _allowance(now)
    )
    resting = modes[YAW]
    for torn_may_stick, stuck in ((False, 1), (False, 0), (True, 1)):
        for right in (1, -1, 0):
            for left in (1, -1, 0):
                for yaw in (1, -1, 0) if resting != FREE else (FREE, FREE, FREE):
                    kept = (right == 0) + (left == 0) + (yaw == 0)
                    sticks = (torn_right and right == 0) or (torn_left and left == 0)
                    if kept != stuck or sticks != torn_may_stick:
                        continue
                    modes[RIGHT], modes[LEFT], modes[YAW] = right, left, yaw
                    if _consistent(laws, params, states, at, inputs, modes):
                        return True
    modes[RIGHT], modes[LEFT], modes[YAW] = 0, 0, resting
    return False


@compiled
def _torn(rest: Range, allowance: float) -> tuple[bool, bool]:
    """Tell which wheels exceed their limit at rest, whatever yaw friction takes.

    Both, where each could hold but not the two together.
    """
    right = allowance + min(rest.right_high - rest.yaw_low, rest.yaw_high - rest.right_low) < 0.0
    left = allowance + min(rest.left_high - rest.yaw_low, rest.yaw_high - rest.left_low) < 0.0
    apart = not (right or left)
    return right or apart, left or apart


@compiled
def _consistent(
    laws: Laws, params: Array, states: Array, at: Motion, inputs: Inputs, modes: Modes
) -> bool:
    """Tell whether contacts at speed 0 accelerate the way that their modes say."""
    now = instant_at(laws, params, states, at, inputs, modes)
    right, left = accelerations(now, sliding_reaction(at, now, modes), modes)
    moves = (modes[RIGHT] == 0 or modes[RIGHT] * right > 0.0) and (
        modes[LEFT] == 0 or modes[LEFT] * left > 0.0
    )
    turns = abs(modes[YAW]) != 1 or modes[YAW] * (right - left) > 0.0
    return moves and turns and slack(laws, params, states, at, inputs, modes) >= 0.0
