"""How prediction errors answer to small pushes: the predictor made linear along a run.

Only single steps are differenced. What they carry on is a recursion, so one pass over a run
serves any number of pushes; and where a wheel breaks away a little sooner, no more than that
step feels it.
"""

from dataclasses import dataclass

import numpy as np
from numba import types

from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.fitting.predictor import (
    DISTURBANCE,
    MEMORY,
    SPEED,
    at_end,
    heard,
)
from diffbot_sim.identification.fitting.steps import Steps
from diffbot_sim.identification.recordings.stretches import Stretch, largest_command
from diffbot_sim.identification.statistics.parallel import each
from diffbot_sim.physics.compiled import compiled, entry
from diffbot_sim.physics.dynamics import MATRIX
from diffbot_sim.physics.model import Model
from diffbot_sim.records import Array

# Differences are of the size of this share of the largest command.
SHARE = 0.01
CUBE = types.Array(types.float64, 3, 'C')


@dataclass(frozen=True)
class Response:
    """Steps of a prediction made linear, and what its noise model does between them.

    steps, shape (k, 4, 4): derivative of the twist that is predicted to be measured, and of the
    twist at that moment, by the twist one sample before, as corrected, and by a force [N] and
    torque [N·m] on the body in between; weight, shape (k, 2): what an error counts; taken, shape
    (k, 2): share of it by which the twist is corrected; gain, shape (k, 2): force and torque that
    an error that counts adds to the disturbance; memory, shape (k, 2): share of that which is left
    from the sample before.
    """

    steps: Array
    weight: Array
    taken: Array
    gain: Array
    memory: Array

    def errors(self, pushes: Array) -> Array:
        """Return what pushes, shape (k, 2, q), add to the innovations, to first order.

        Each acts from its sample to the next.
        """
        before = np.zeros(pushes.shape)
        before[1:] = pushes[:-1]
        return self.carried(self.steps[:, :, 2:] @ before)

    def carried(self, changes: Array) -> Array:
        """Return what changes of single steps, shape (k, 4, q), add to the innovations."""
        out = np.zeros((len(changes), 2, changes.shape[2]))
        changes = np.ascontiguousarray(changes)
        _carry(self.steps, self.weight, self.taken, self.gain, self.memory, changes, out)
        return out

    def followed(self, errors: Array) -> Array:
        """Return what changes of the innovations, shape (k, 2, q), add to the disturbance."""
        out = np.zeros(errors.shape)
        _follow(self.gain, self.memory, np.ascontiguousarray(errors), out)
        return out


def responses(fit: Fit) -> tuple[Response, ...]:
    """Return how the errors of a fit on each stretch answer to pushes."""
    force = SHARE * max(largest_command(fit.stretches), 1e-3)
    return tuple(each(lambda s: response(fit.model, s, fit.gains, force), fit.stretches))


def response(model: Model, stretch: Stretch, gains: Array, force: float) -> Response:
    """Make the prediction of a stretch linear, by differences of the size of a force [N]."""
    steps, body = Steps(model, stretch, gains), model.pack()[:2]
    push = force * np.array([1.0, model.half_separation])
    sizes = np.concatenate([push * stretch.interval / body, push])
    slopes = np.stack([steps.slope(by) for by in np.diag(sizes)], axis=-1)
    intervals = stretch.intervals[:, None]
    gain = gains[DISTURBANCE] * at_end(stretch) * body / intervals
    counting = heard(stretch, gains)
    taken = counting.taken(gains[SPEED] * at_end(stretch))
    return Response(slopes, counting.weight, taken, gain, gains[MEMORY] ** intervals)


@compiled
def _along(slopes: Array, v: float, omega: float, force: float, torque: float) -> float:
    return float(slopes[0] * v + slopes[1] * omega + slopes[2] * force + slopes[3] * torque)


@entry(types.void(CUBE, MATRIX, MATRIX, MATRIX, MATRIX, CUBE, CUBE))
def _carry(  # type: ignore[no-untyped-def]
    steps, weight, taken, gain, memory, changes, out
) -> None:
    """Fill out: what each change, carried on from step to step, adds to the errors."""
    for q in range(changes.shape[2]):
        v, omega, pushing, turning = 0.0, 0.0, 0.0, 0.0
        for k in range(1, len(steps)):
            told_v = _along(steps[k, 0], v, omega, pushing, turning) + changes[k, 0, q]
            told_omega = _along(steps[k, 1], v, omega, pushing, turning) + changes[k, 1, q]
            out[k, 0, q], out[k, 1, q] = -weight[k, 0] * told_v, -weight[k, 1] * told_omega
            now_v = _along(steps[k, 2], v, omega, pushing, turning) + changes[k, 2, q]
            now_omega = _along(steps[k, 3], v, omega, pushing, turning) + changes[k, 3, q]
            v, omega = now_v - taken[k, 0] * told_v, now_omega - taken[k, 1] * told_omega
            pushing = memory[k, 0] * pushing + gain[k, 0] * out[k, 0, q]
            turning = memory[k, 1] * turning + gain[k, 1] * out[k, 1, q]


@entry(types.void(MATRIX, MATRIX, CUBE, CUBE))
def _follow(gain, memory, errors, out) -> None:  # type: ignore[no-untyped-def]
    """Fill out: what errors add to the disturbance, after each of them."""
    for k in range(1, len(errors)):
        for axis in range(2):
            for q in range(errors.shape[2]):
                kept = memory[k, axis] * out[k - 1, axis, q]
                out[k, axis, q] = kept + gain[k, axis] * errors[k, axis, q]
