"""One-step prediction: the simulator with a noise model, in innovations form.

Real robots meet forces that no model has (uneven floor). A pure simulation integrates them, so
its error is strongly coloured and every test on it cries wolf. Here each odometry sample corrects
speed and a disturbance force by a small gain; with the gains fitted the errors of the
prediction are white. Gains 0 give the free-running simulation back. Heading and wheel angles are
those measured: errors of speed would add up in them, and with them go slopes and ripples.
"""

from dataclasses import dataclass, replace
from math import exp, nan

import numpy as np
from numba import types

from diffbot_sim.identification.recordings.start import PREDICTION_STEP
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.recordings.unheard import Unheard, all_heard
from diffbot_sim.physics.compiled import entry
from diffbot_sim.physics.composition import compose
from diffbot_sim.physics.correction import correct, put
from diffbot_sim.physics.dynamics import ARRAY, FUNCTION_TYPES, INTEGERS, MATRIX, Dynamics
from diffbot_sim.physics.embedding import embedded
from diffbot_sim.physics.encoders import measured
from diffbot_sim.physics.instant import HALF_SEPARATION, INERTIA, MASS
from diffbot_sim.physics.model import Model
from diffbot_sim.physics.schedule import scheduled
from diffbot_sim.physics.simulation import (
    HeldCommands,
    advance_held,
    command_at,
    initial_modes,
    initial_states,
    initial_vector,
    inputs_of,
    workspace,
)
from diffbot_sim.physics.snapshot import keep, snapshot_size
from diffbot_sim.physics.state import State
from diffbot_sim.physics.vector import HEADING, roll, twist_of, way_of
from diffbot_sim.records import Array

# In this time [s] wheels come to where they are measured to stand: noise of that is smoothed.
ROLLED = 0.5
# An error that counts so little tells how a robot moves of which it is not known whether it does.
UNKNOWN = 0.5
# Gains: of speed, of the disturbance, and the disturbance's memory over one second; v, then ω.
NO_GAIN = np.array([0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
SPEED, DISTURBANCE, MEMORY = [0, 3], [1, 4], [2, 5]


@dataclass(frozen=True)
class Prediction:
    """Errors of the one-step prediction, and what the predictor held to be true.

    innovation: measured - predicted twist, as it counts where commands were lost, shape (k, 2);
    twist: of the moment, corrected, shape (k, 2); disturbance: estimated force [N] and torque
    [N·m] on the body, shape (k, 2); snapshots: what the next step sets out from, a row for each
    sample.
    """

    innovation: Array
    twist: Array
    disturbance: Array
    snapshots: Array


def predict(model: Model, stretch: Stretch, gains: Array) -> Prediction:
    """Predict each sample of a stretch from those before it.

    gains, shape (6,): see NO_GAIN.
    """
    count, model = len(stretch.time), embedded(model)
    start = float(stretch.time[0])
    commands = scheduled(model, stretch.run.commands, start)
    states = initial_states(model, commands, start)
    innovation, out = np.zeros((count, 2)), np.empty((count, 4))
    snapshots = np.empty((count, snapshot_size(states)))
    counting = heard(stretch, gains)
    _predict(
        *compose(model.kinds),
        model.pack(),
        states,
        initial_vector(model, _set_out(model, stretch.start)),
        np.ascontiguousarray(commands.time),
        np.ascontiguousarray(commands.force),
        PREDICTION_STEP,
        np.ascontiguousarray(stretch.time),
        np.ascontiguousarray(stretch.twist),
        np.array(stretch.run.odometry.means, dtype=float),
        stretch.heading,
        np.ascontiguousarray(stretch.way),
        np.ascontiguousarray(gains),
        gains[MEMORY] ** stretch.intervals[:, None],
        counting.taken(gains[SPEED] * at_end(stretch)),
        counting.weight,
        np.ascontiguousarray(stretch.pushes),
        *workspace(),
        innovation,
        out,
        snapshots,
    )
    return Prediction(innovation, out[:, 0:2], out[:, 2:4], snapshots)


def _set_out(model: Model, start: State) -> State:
    """Return where a prediction starts: no place where nothing depends on it, which saves time."""
    if any(effect.is_of_place for effect in model.effects):
        return start
    return replace(start, x=nan, y=nan)


def at_end(stretch: Stretch) -> Array:
    """Return how much larger errors are at the end of an interval than as they are told: (2,).

    What a force did all the while is at the end twice what it is on the mean.
    """
    return 1.0 + np.array(stretch.run.odometry.means, dtype=float)


def heard(stretch: Stretch, gains: Array) -> Unheard:
    """Return how the errors of a stretch count: where nothing corrects a model, all alike."""
    return stretch.unheard if np.any(gains) else all_heard(len(stretch.time))


@entry(
    types.void(
        *FUNCTION_TYPES,
        *(ARRAY, ARRAY, ARRAY, ARRAY, MATRIX, types.float64),
        *(ARRAY, MATRIX, ARRAY, ARRAY, MATRIX, ARRAY, MATRIX, MATRIX, MATRIX, MATRIX),
        *(INTEGERS, MATRIX, MATRIX, MATRIX, MATRIX),
    )
)
def _predict(  # type: ignore[no-untyped-def]
    laws, settle, step, params, states, z, command_time, force, max_step, times, twist, means,
    heading, way, gains, memory, taken, weight, push, modes, work, innovation, out, snapshots
) -> None:  # fmt: skip
    """Fill innovation; out: corrected twist, disturbance; and a snapshot after each sample."""
    dynamics, commands = Dynamics(laws, settle, step), HeldCommands(command_time, force, max_step)
    current = command_at(commands, -1, times[0])
    initial_modes(laws, params, states, z, modes, inputs_of(commands, current, 0.0, 0.0), times[0])
    pushing, turning = 0.0, 0.0
    end_v, end_omega = 1.0 + means[0], 1.0 + means[1]
    for k, time in enumerate(times):
        if k > 0:
            begin, acting = times[k - 1], (pushing + push[k - 1, 0], turning + push[k - 1, 1])
            interval, before = time - begin, way_of(params, z)
            current = advance_held(
                dynamics, params, states, z, modes, commands, current, acting, begin, time, work
            )
            v, omega = measured(params, means, z, before, interval)
            missed = twist[k, 0] - v, twist[k, 1] - omega
            by = taken[k, 0] * missed[0], taken[k, 1] * missed[1]
            if min(weight[k, 0], weight[k, 1]) < UNKNOWN:
                put(z, modes, params[HALF_SEPARATION], by[0], by[1])
            else:
                correct(z, modes, params[HALF_SEPARATION], by[0], by[1])
            error_v, error_omega = weight[k, 0] * missed[0], weight[k, 1] * missed[1]
            innovation[k, 0], innovation[k, 1] = error_v, error_omega
            by_v, by_omega = gains[1] * end_v * error_v, gains[4] * end_omega * error_omega
            pushing = memory[k, 0] * pushing + params[MASS] / interval * by_v
            turning = memory[k, 1] * turning + params[INERTIA] / interval * by_omega
            roll(params, z, way[k, 0], way[k, 1], 1.0 - exp(-interval / ROLLED))
        z[HEADING] = heading[k]
        out[k, 0], out[k, 1] = twist_of(params, z)
        out[k, 2], out[k, 3] = pushing, turning
        keep(z, modes, states, snapshots[k])
