"""How prediction errors answer to small pushes: the predictor made linear along a run.

Only single steps are differenced. What they carry on is a recursion, so one pass over a run
serves any number of pushes; and where a wheel breaks away a little sooner, no more than that
step feels it.
"""

from dataclasses import dataclass

import numpy as np
from numba import types

from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.fitting.predictor import MAX_STEP, Prediction, predict
from diffbot_sim.identification.recordings.stretches import Stretch, largest_command
from diffbot_sim.identification.statistics.parallel import each
from diffbot_sim.physics.compiled import compiled, entry
from diffbot_sim.physics.composition import ARRAY, FUNCTION_TYPES, compose
from diffbot_sim.physics.contact import Modes
from diffbot_sim.physics.correction import correct
from diffbot_sim.physics.embedding import embedded
from diffbot_sim.physics.encoders import measured, twist_of, way_of
from diffbot_sim.physics.model import Model
from diffbot_sim.physics.schedule import scheduled
from diffbot_sim.physics.simulation import (
    INTEGERS,
    MATRIX,
    Drive,
    advance_held,
    command_at,
    workspace,
)
from diffbot_sim.physics.snapshot import restore
from diffbot_sim.physics.vector import STATE_SIZE
from diffbot_sim.records import Array

# Differences are of the size of this share of the largest command.
SHARE = 0.01
CUBE = types.Array(types.float64, 3, 'C')


@dataclass(frozen=True)
class Response:
    """Steps of a prediction made linear, and what its noise model does between them.

    steps, shape (k, 4, 4): derivative of the twist that is predicted to be measured, and of the
    twist at that moment, by the twist one sample before, as corrected, and by a force [N] and
    torque [N·m] on the body in between; taken, shape (2,): share of an error by which the twist is
    corrected; gain, shape (k, 2): force and torque that an
    error adds to the disturbance; memory, shape (k, 2): share of it that is left from the sample
    before.
    """

    steps: Array
    taken: Array
    gain: Array
    memory: Array

    def errors(self, pushes: Array) -> Array:
        """Return what pushes, shape (k, 2, q), add to the innovations, to first order.

        Each acts from its sample to the next.
        """
        out = np.zeros(pushes.shape)
        _carry(self.steps, self.taken, self.gain, self.memory, np.ascontiguousarray(pushes), out)
        return out


def responses(fit: Fit) -> tuple[Response, ...]:
    """Return how the errors of a fit on each stretch answer to pushes."""
    force = SHARE * max(largest_command(fit.stretches), 1e-3)
    return tuple(each(lambda s: response(fit.model, s, fit.gains, force), fit.stretches))


def response(model: Model, stretch: Stretch, gains: Array, force: float) -> Response:
    """Make the prediction of a stretch linear, by differences of the size of a force [N]."""
    model, count = embedded(model), len(stretch.time)
    before = predict(model, stretch, gains)
    commands = scheduled(model, stretch.run.commands)
    params, steps = model.pack(), np.zeros((count, 4, 4))
    means = np.array(stretch.run.odometry.means, dtype=float)
    body = params[:2]
    push = force * np.array([1.0, model.half_separation])
    intervals = np.diff(stretch.time, prepend=stretch.time[0] - stretch.interval)[:, None]
    _difference(
        *compose(tuple(type(effect) for effect in model.effects)),
        params,
        np.ascontiguousarray(commands.time),
        np.ascontiguousarray(commands.force),
        MAX_STEP,
        np.ascontiguousarray(stretch.time),
        np.diag(np.concatenate([push * stretch.interval / body, push])),
        np.ascontiguousarray(before.disturbance),
        np.hstack([stretch.twist - before.innovation, before.foreseen]),
        means,
        before.snapshots,
        *_place(before),
        steps,
    )
    at_end = 1.0 + means
    gain = gains[[1, 4]] * at_end * body / intervals
    return Response(steps, gains[[0, 3]] * at_end, gain, gains[[2, 5]] ** intervals)


def _place(prediction: Prediction) -> tuple[Array, Array, Modes, Array]:
    """Return what a step is taken in: z, effect states, modes and workspace."""
    modes, work = workspace()
    states = prediction.snapshots.shape[1] - STATE_SIZE - len(modes)
    return np.empty(STATE_SIZE), np.empty(states), modes, work


@entry(
    types.void(
        *FUNCTION_TYPES,
        *(ARRAY, ARRAY, MATRIX, types.float64, ARRAY, MATRIX, MATRIX, MATRIX, ARRAY, MATRIX),
        *(ARRAY, ARRAY, INTEGERS, MATRIX, CUBE),
    )
)
def _difference(  # type: ignore[no-untyped-def]
    laws,
    settle,
    params,
    command_time,
    force,
    max_step,
    times,
    changes,
    disturbance,
    predicted,
    means,
    snapshots,
    z,
    states,
    modes,
    work,
    steps,
) -> None:
    """Fill steps: of both sides the flatter slope, as a jump lies on one side and is none."""
    drive, b, current = Drive(command_time, force, max_step), params[2], -1
    for k in range(1, len(times)):
        current = command_at(drive, current, times[k - 1])
        for column in range(4):
            for side in (1.0, -1.0):
                restore(snapshots[k - 1], z, modes, states)
                by, way = changes[column], way_of(params, z)
                correct(z, modes, b, side * by[0], side * by[1])
                push = disturbance[k - 1]
                acting = (push[0] + side * by[2], push[1] + side * by[3])
                advance_held(
                    laws,
                    settle,
                    params,
                    states,
                    z,
                    modes,
                    drive,
                    current,
                    acting,
                    times[k - 1],
                    times[k],
                    work,
                )
                told = measured(params, means, z, way, times[k] - times[k - 1])
                for row, value in enumerate((*told, *twist_of(params, z))):
                    slope = (value - predicted[k, row]) / (side * by[column])
                    if side > 0.0 or abs(slope) < abs(steps[k, row, column]):
                        steps[k, row, column] = slope


@compiled
def _along(slopes: Array, v: float, omega: float, force: float, torque: float) -> float:
    return float(slopes[0] * v + slopes[1] * omega + slopes[2] * force + slopes[3] * torque)


@entry(types.void(CUBE, ARRAY, MATRIX, MATRIX, CUBE, CUBE))
def _carry(  # type: ignore[no-untyped-def]
    steps, taken, gain, memory, pushes, out
) -> None:
    """Fill out: what each push, carried on from step to step, adds to the errors."""
    for q in range(pushes.shape[2]):
        v, omega, pushing, turning = 0.0, 0.0, 0.0, 0.0
        for k in range(1, len(steps)):
            force, torque = pushing + pushes[k - 1, 0, q], turning + pushes[k - 1, 1, q]
            told_v = _along(steps[k, 0], v, omega, force, torque)
            told = _along(steps[k, 1], v, omega, force, torque)
            out[k, 0, q], out[k, 1, q] = -told_v, -told
            now_v = _along(steps[k, 2], v, omega, force, torque)
            now = _along(steps[k, 3], v, omega, force, torque)
            v, omega = now_v - taken[0] * told_v, now - taken[1] * told
            pushing = memory[k, 0] * pushing - gain[k, 0] * told_v
            turning = memory[k, 1] * turning - gain[k, 1] * told
