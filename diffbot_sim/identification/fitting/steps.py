"""The single steps of a prediction, taken again with something changed."""

import numpy as np
from numba import types

from diffbot_sim.identification.fitting.predictor import Prediction, predict
from diffbot_sim.identification.recordings.start import PREDICTION_STEP
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.statistics.minimisation import flatter
from diffbot_sim.physics.compiled import entry
from diffbot_sim.physics.composition import compose
from diffbot_sim.physics.contact import Modes
from diffbot_sim.physics.correction import correct
from diffbot_sim.physics.dynamics import ARRAY, FUNCTION_TYPES, INTEGERS, MATRIX, Dynamics
from diffbot_sim.physics.embedding import embedded
from diffbot_sim.physics.encoders import measured
from diffbot_sim.physics.instant import HALF_SEPARATION
from diffbot_sim.physics.model import Model
from diffbot_sim.physics.schedule import scheduled
from diffbot_sim.physics.simulation import (
    HeldCommands,
    advance_held,
    command_at,
    workspace,
)
from diffbot_sim.physics.snapshot import restore, states_in
from diffbot_sim.physics.vector import STATE_SIZE, twist_of, way_of
from diffbot_sim.records import Array

UNCHANGED = np.zeros(4)


class Steps:
    """The single steps of a prediction, to be taken again from where each of them set out."""

    def __init__(self, model: Model, stretch: Stretch, gains: Array) -> None:
        self._model, self._stretch = embedded(model), stretch
        self._before = predict(model, stretch, gains)
        self._acting = np.ascontiguousarray(self._before.disturbance + stretch.pushes)
        self._predicted = self._taken(self._model, UNCHANGED)

    def changed(self, model: Model, by: Array = UNCHANGED) -> Array:
        """Return by how much steps end elsewhere, shape (k, 4): twist as measured; at that moment.

        model: of the same body and effects, with other values; by, shape (4,): what the twist
        before each step is changed by, and force [N] and torque [N·m] on the body while it lasts.
        """
        return self._taken(embedded(model), by) - self._predicted

    def _taken(self, model: Model, by: Array) -> Array:
        """Return how steps end, shape (k, 4); there is none before the first sample."""
        stretch = self._stretch
        commands = scheduled(model, stretch.run.commands, float(stretch.time[0]))
        out = np.zeros((len(stretch.time), 4))
        _take(
            *compose(model.kinds),
            model.pack(),
            np.ascontiguousarray(commands.time),
            np.ascontiguousarray(commands.force),
            PREDICTION_STEP,
            np.ascontiguousarray(stretch.time),
            by,
            np.array(stretch.run.odometry.means, dtype=float),
            self._acting,
            self._before.snapshots,
            *_place(self._before),
            out,
        )
        return out

    def slope(self, by: Array) -> Array:
        """Return the same for each unit that all is changed by, of both sides the flatter one.

        A jump lies on one side and is no slope.
        """
        size = by.max()
        more, less = (self.changed(self._model, sign * by) / (sign * size) for sign in (1.0, -1.0))
        return flatter(more, less)


def _place(prediction: Prediction) -> tuple[Array, Array, Modes, Array]:
    """Return what a step is taken in: z, effect states, modes and workspace."""
    modes, work = workspace()
    return np.empty(STATE_SIZE), np.empty(states_in(prediction.snapshots)), modes, work


@entry(
    types.void(
        *FUNCTION_TYPES,
        *(ARRAY, ARRAY, MATRIX, types.float64, ARRAY, ARRAY, ARRAY, MATRIX, MATRIX),
        *(ARRAY, ARRAY, INTEGERS, MATRIX, MATRIX),
    )
)
def _take(  # type: ignore[no-untyped-def]
    laws,
    settle,
    step,
    params,
    command_time,
    force,
    max_step,
    times,
    by,
    means,
    disturbance,
    snapshots,
    z,
    states,
    modes,
    work,
    out,
) -> None:
    """Fill out: each step's end, the twist as measured and at that moment."""
    dynamics, commands = Dynamics(laws, settle, step), HeldCommands(command_time, force, max_step)
    b, current = params[HALF_SEPARATION], -1
    for k in range(1, len(times)):
        current = command_at(commands, current, times[k - 1])
        restore(snapshots[k - 1], z, modes, states)
        correct(z, modes, b, by[0], by[1])
        way, push = way_of(params, z), disturbance[k - 1]
        advance_held(
            dynamics,
            params,
            states,
            z,
            modes,
            commands,
            current,
            (push[0] + by[2], push[1] + by[3]),
            times[k - 1],
            times[k],
            work,
        )
        out[k, 0], out[k, 1] = measured(params, means, z, way, times[k] - times[k - 1])
        out[k, 2], out[k, 3] = twist_of(params, z)
