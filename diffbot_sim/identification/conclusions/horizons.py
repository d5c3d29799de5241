"""Errors over horizons: how far ahead each model can be believed on held-out data.

At regular moments the simulation is restarted and compared with the measurement so many seconds
later. All models restart from the same speeds: those that one-step prediction with the identified
model holds to be true, since a single sample is noise. From there each runs on the recorded
forces alone. Where it ends counts, not the way there: errors grow with the horizon.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.fitting.predictor import predict
from diffbot_sim.identification.recordings.measurement import simulated
from diffbot_sim.identification.recordings.start import WINDOW
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.result import Errors, Horizon
from diffbot_sim.identification.statistics.norms import norm
from diffbot_sim.physics.model import Model
from diffbot_sim.physics.simulation import LONGEST_STEP
from diffbot_sim.physics.state import State
from diffbot_sim.records import Array

AHEAD = (1.0, 5.0)
# Restarts are this far apart [s], or farther, so that so many do for all stretches together.
SPACING, MOST_RESTARTS = 0.2, 300
# A sample stands for the end of a horizon up to so many intervals from it.
LATEST = 1.5


def horizons(
    models: Sequence[Model], final: Fit, held_out: Sequence[Stretch], errors: Errors
) -> tuple[Horizon, ...]:
    """Return the errors of (declared, recalibrated, with effects) one step to endless seconds.

    final: the identified model with the gains of its noise model. A horizon that no held-out
    stretch is long enough for is left out.
    """
    ahead = [_one_step(models, final, held_out), *_restarted(models, final, held_out)]
    free = (errors.declared, errors.recalibrated, errors.with_effects)
    return (*ahead, Horizon('free-running', None, len(held_out), *free))


def _one_step(models: Sequence[Model], final: Fit, held_out: Sequence[Stretch]) -> Horizon:
    """Pool the innovations once the predictor has settled; one after a hole is no single step."""

    def innovations(model: Model) -> Array:
        return np.concatenate(
            [
                predict(model, stretch, final.gains).innovation[_settled(stretch)]
                for stretch in held_out
            ]
        )

    pooled = [innovations(model) for model in models]
    interval = float(np.median([stretch.interval for stretch in held_out]))
    return Horizon('one step', interval, len(pooled[0]), *map(norm, pooled))


def _settled(stretch: Stretch) -> NDArray[np.bool_]:
    return np.asarray((stretch.time > stretch.time[0] + WINDOW) & stretch.used)


def _restarted(models: Sequence[Model], final: Fit, held_out: Sequence[Stretch]) -> list[Horizon]:
    """Restart every model at the same moments; pool the errors at the end of each horizon."""
    spacing = max(SPACING, sum(s.time[-1] - s.time[0] for s in held_out) / MOST_RESTARTS)
    errors = np.concatenate([_errors(models, final, s, spacing) for s in held_out])
    result = []
    for index, seconds in enumerate(AHEAD):
        at_end = errors[:, :, index]
        known = at_end[np.isfinite(at_end).all(axis=(1, 2))]
        if len(known):
            pooled = map(norm, known.swapaxes(0, 1))
            result.append(Horizon(f'{seconds:g} s', seconds, len(known), *pooled))
    return result


def _errors(models: Sequence[Model], final: Fit, stretch: Stretch, spacing: float) -> Array:
    """Return measured - simulated twist: restarts × models × AHEAD × (v, ω); NaN past the end."""
    time = stretch.time
    speeds = predict(final.model, stretch, final.gains).twist
    wanted = np.arange(time[0] + WINDOW, time[-1] - AHEAD[0], spacing)
    moments = np.unique(np.searchsorted(time, wanted))
    errors = np.full((len(moments), len(models), len(AHEAD), 2), np.nan)
    for row, moment in enumerate(moments):
        start, (told, ends) = state_at(stretch, speeds, moment), _ends(stretch, moment)
        # What is told at an end may be a mean since the sample before.
        stamps = np.unique([moment, *(ends - 1), *ends])
        for column, model in enumerate(models):
            run = simulated(model, stretch, time[stamps], start, LONGEST_STEP)
            at_ends = run.twist[np.searchsorted(stamps, ends)]
            errors[row, column, told] = stretch.twist[ends] - at_ends
    return errors


def _ends(stretch: Stretch, moment: int) -> tuple[NDArray[np.bool_], NDArray[np.intp]]:
    """Return which horizons are told of, and the samples at their ends: none behind a hole."""
    time = stretch.time
    wanted = time[moment] + np.array(AHEAD)
    ends = np.minimum(np.searchsorted(time, wanted - 1e-6), len(time) - 1)
    told = np.abs(time[ends] - wanted) < LATEST * stretch.interval
    return told, ends[told]


def state_at(stretch: Stretch, speeds: Array, moment: int) -> State:
    """Return the state at a sample: speeds as given, place and heading as measured."""
    travelled, turned = stretch.way[moment]
    x, y = (0.0, 0.0) if stretch.pose is None else stretch.pose[moment, :2]
    return State(
        x=float(x),
        y=float(y),
        heading=float(stretch.heading[moment]),
        v=float(speeds[moment, 0]),
        omega=float(speeds[moment, 1]),
        travelled=float(travelled),
        turned=float(turned),
    )
