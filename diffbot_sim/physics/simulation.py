"""Drives a model with recorded or prescribed forces; the only clock is the stamps it is given."""

from typing import NamedTuple

import numpy as np
from numba import types

from diffbot_sim.physics import contact
from diffbot_sim.physics.compiled import compiled, entry
from diffbot_sim.physics.composition import compose
from diffbot_sim.physics.contact import Modes, instant_at
from diffbot_sim.physics.dynamics import ARRAY, FUNCTION_TYPES, INTEGERS, MATRIX, Dynamics, Laws
from diffbot_sim.physics.instant import Inputs
from diffbot_sim.physics.kinematics import wheel_speeds
from diffbot_sim.physics.model import Model
from diffbot_sim.physics.runge_kutta import WORK_ROWS
from diffbot_sim.physics.schedule import scheduled
from diffbot_sim.physics.snapshot import CONTACTS
from diffbot_sim.physics.stages import Traction
from diffbot_sim.physics.state import State
from diffbot_sim.physics.stepper import advance_through, update_contacts
from diffbot_sim.physics.vector import (
    ANGLE_RIGHT,
    SPEED_RIGHT,
    STATE_SIZE,
    X,
    copy_state,
    evaluate,
    motion_at,
)
from diffbot_sim.records import Array, Commands, Trajectory

# Steps are at most so long [s] unless asked otherwise.
LONGEST_STEP = 5e-3
# Where things begin in a row of output: the state z, and what follows from it, in pairs.
POSE, WHEEL_ANGLE, WHEEL_SPEED = X, ANGLE_RIGHT, SPEED_RIGHT
TWIST, TRACTION, FRICTION, OUTPUT_SIZE = range(STATE_SIZE, STATE_SIZE + 8, 2)


def simulate(
    model: Model,
    commands: Commands,
    times: Array,
    start: State | None = None,
    max_step: float = LONGEST_STEP,
) -> Trajectory:
    """Return the free-running motion at the given stamps.

    times [s], shape (k,), increasing; the run starts at times[0] from `start` (rest at the
    origin). Each command is held until the next; before the first one the force is 0.
    Steps are at most max_step [s] long, cut at stamps and command changes.
    """
    functions = compose(model.kinds)
    commands = scheduled(model, commands, float(times[0]))
    z = initial_vector(model, start or State())
    out = np.empty((len(times), OUTPUT_SIZE))
    _simulate(
        *functions,
        model.pack(),
        initial_states(model, commands, float(times[0])),
        z,
        np.ascontiguousarray(commands.time),
        np.ascontiguousarray(commands.force),
        max_step,
        np.ascontiguousarray(times),
        *workspace(),
        out,
    )
    return Trajectory(
        time=times,
        pose=out[:, POSE:WHEEL_ANGLE],
        wheel_angle=out[:, WHEEL_ANGLE:WHEEL_SPEED],
        wheel_speed=out[:, WHEEL_SPEED:TWIST],
        twist=out[:, TWIST:TRACTION],
        traction=out[:, TRACTION:FRICTION],
        friction=out[:, FRICTION:],
    )


def workspace() -> tuple[Modes, Array]:
    """Return the modes of the contacts, and rows that the stepper works in."""
    return np.ones(CONTACTS, np.int64), np.empty((WORK_ROWS, STATE_SIZE))


def initial_vector(model: Model, start: State) -> Array:
    """Return the state vector z of a start: pose, wheel angles, wheel speeds."""
    b, r = model.half_separation, model.robot.wheel_radius
    ways, speeds = (
        wheel_speeds(start.travelled, start.turned, b),
        wheel_speeds(start.v, start.omega, b),
    )
    return np.array([start.x, start.y, start.heading, ways[0] / r, ways[1] / r, *speeds])


def initial_states(model: Model, commands: Commands, time: float) -> Array:
    """Return the effect states at a time [s]: what the commands before it have left behind.

    commands: as scheduled. The first is taken to have acted for long; before it the force is 0.
    """
    known = len(commands.time) > 0 and commands.time[0] <= time
    first = Traction(*map(float, commands.force[0])) if known else Traction(0.0, 0.0)
    states = np.array([s for effect in model.effects for s in effect.initial_state(first)])
    if known and len(states) > 0:
        settle = compose(model.kinds).settle
        stamps, force = map(np.ascontiguousarray, (commands.time, commands.force))
        _settle_through(settle, model.pack(), states, np.zeros(STATE_SIZE), stamps, force, time)
    return states


@entry(
    types.void(FUNCTION_TYPES[1], ARRAY, ARRAY, ARRAY, ARRAY, MATRIX, types.float64),
)
def _settle_through(  # type: ignore[no-untyped-def]
    settle, params, states, z, command_time, force, until
) -> None:
    """Let the effect states live through all commands up to a time [s], the first one for ever."""
    for_ever = motion_at(params, z, command_time[0], np.inf)
    settle(params, states, for_ever, Inputs(force[0, 0], force[0, 1], 0.0, 0.0))
    for k, begin in enumerate(command_time):
        if begin >= until:
            break
        end = min(until, command_time[k + 1]) if k + 1 < len(command_time) else until
        at = motion_at(params, z, begin, end - begin)
        settle(params, states, at, Inputs(force[k, 0], force[k, 1], 0.0, 0.0))


@compiled
def initial_modes(
    laws: Laws, params: Array, states: Array, z: Array, modes: Modes, inputs: Inputs, time: float
) -> None:
    """Set the modes of a robot whose history is unknown."""
    at = motion_at(params, z, time, 0.0)
    contact.modes_of(z, evaluate(laws, params, states, at, inputs, 1.0, 1.0).dry_torque, modes)


class HeldCommands(NamedTuple):
    """Commands as compiled code reads them: stamps [s], forces [N] (n, 2), longest step [s]."""

    time: Array
    force: Array
    max_step: float


@compiled
def command_at(commands: HeldCommands, current: int, time: float) -> int:
    """Return the index of the command in force at a time, counted on from an earlier one."""
    while current + 1 < len(commands.time) and commands.time[current + 1] <= time:
        current += 1
    return current


@compiled
def inputs_of(commands: HeldCommands, current: int, force: float, torque: float) -> Inputs:
    """Return the inputs while a command is in force (-1: none yet) and the body is pushed."""
    if current < 0:
        return Inputs(0.0, 0.0, force, torque)
    return Inputs(commands.force[current, 0], commands.force[current, 1], force, torque)


@compiled
def advance_held(
    dynamics: Dynamics,
    params: Array,
    states: Array,
    z: Array,
    modes: Modes,
    commands: HeldCommands,
    current: int,
    push: tuple[float, float],
    time: float,
    until: float,
    work: Array,
) -> int:
    """Advance from time to until [s], each command held until the next; return the last one.

    push: a force [N] along x and a torque [N·m] that act on the body all the while.
    """
    while time < until:
        current = command_at(commands, current, time)
        end = until
        if current + 1 < len(commands.time):
            end = min(until, commands.time[current + 1])
        inputs = inputs_of(commands, current, push[0], push[1])
        lasting, longest = end - time, commands.max_step
        advance_through(dynamics, params, states, z, modes, inputs, time, lasting, longest, work)
        time = end
    return command_at(commands, current, until)


@compiled
def observe(
    laws: Laws,
    params: Array,
    states: Array,
    z: Array,
    modes: Modes,
    inputs: Inputs,
    time: float,
    row: Array,
) -> None:
    """Fill one row of output: z, twist, traction, friction, all at this moment."""
    update_contacts(laws, params, states, z, modes, inputs, time)
    at = motion_at(params, z, time, 0.0)
    reaction = contact.reaction_at(laws, params, states, at, inputs, modes)
    now = instant_at(laws, params, states, at, inputs, modes)
    copy_state(z, row)
    row[TWIST], row[TWIST + 1] = at.v, at.omega
    row[TRACTION], row[TRACTION + 1] = now.traction_right, now.traction_left
    row[FRICTION], row[FRICTION + 1] = reaction.right, reaction.left


@entry(
    types.void(
        *FUNCTION_TYPES,
        *(ARRAY, ARRAY, ARRAY, ARRAY, MATRIX, types.float64, ARRAY, INTEGERS, MATRIX, MATRIX),
    )
)
def _simulate(  # type: ignore[no-untyped-def]
    laws, settle, step, params, states, z, command_time, force, max_step, times, modes, work, out
) -> None:
    """Simulate from times[0] and fill a row of output at each stamp."""
    dynamics, commands = Dynamics(laws, settle, step), HeldCommands(command_time, force, max_step)
    current, push = command_at(commands, -1, times[0]), (0.0, 0.0)
    initial_modes(laws, params, states, z, modes, inputs_of(commands, current, 0.0, 0.0), times[0])
    for k, time in enumerate(times):
        if k > 0:
            begin = times[k - 1]
            current = advance_held(
                dynamics, params, states, z, modes, commands, current, push, begin, time, work
            )
        inputs = inputs_of(commands, current, 0.0, 0.0)
        observe(laws, params, states, z, modes, inputs, time, out[k])
