"""The first state of a stretch, as a model sees it: speeds that fit the first second best."""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from scipy.optimize import least_squares

from diffbot_sim.identification.recordings.measurement import simulated
from diffbot_sim.identification.recordings.stretches import FEW, Stretch
from diffbot_sim.identification.statistics.norms import white_noise
from diffbot_sim.identification.statistics.robust import HUBER, huber
from diffbot_sim.physics.model import Model
from diffbot_sim.physics.state import State
from diffbot_sim.records import Array

WINDOW = 1.0
# Longest integration step while models are fitted [s]; fourth order keeps its error far below any
# odometry's noise.
PREDICTION_STEP = 0.02
# Noise [m/s, rad/s] that is as good as none.
NO_NOISE = 1e-9
# A robot that may well have been at rest was: chance alone lets two speeds explain so much.
REST = 9.0


def start_of(model: Model, stretch: Stretch, max_step: float) -> State:
    """Return the state from which a free-running simulation of a stretch begins.

    A robot that may rest starts at rest exactly. Otherwise one noisy sample would turn into a
    heading error that lasts, so v and ω are fitted to the first WINDOW seconds.
    """
    first = stretch.start
    if first.v == 0.0 and first.omega == 0.0:
        return first
    count = max(10, int(np.searchsorted(stretch.time, stretch.time[0] + WINDOW)))
    time, twist = stretch.time[:count], stretch.twist[:count]
    noise = white_noise(twist) + NO_NOISE

    def errors(twist_at_start: Array) -> Array:
        start = replace(first, v=float(twist_at_start[0]), omega=float(twist_at_start[1]))
        run = simulated(model, stretch, time, start, max_step)
        return np.asarray(((twist - run.twist) / noise).ravel())

    def cost(at: Array) -> float:
        # Robust, but without a limit: what is far from rest must tell, whatever the model errs.
        return float(huber(errors(at)).sum())

    best = _fitted(errors, np.array([first.v, first.omega]))
    moving = cost(best)
    # The line that tells a first state leads to a hollow where the robot turns back at once.
    at_first = twist[:FEW].mean(axis=0)
    if cost(at_first) < moving:
        best = _fitted(errors, at_first)
        moving = cost(best)
    if cost(np.zeros(2)) < moving + REST:
        return replace(first, v=0.0, omega=0.0)
    return replace(first, v=float(best[0]), omega=float(best[1]))


def _fitted(errors: Callable[[Array], Array], guess: Array) -> Array:
    """Return the twist at the start that errs least, shape (2,), beginning from a guess."""
    fit = least_squares(errors, guess, loss='huber', f_scale=HUBER, diff_step=1e-5, max_nfev=10)
    return np.asarray(fit.x)


def restarted(model: Model, stretches: Sequence[Stretch]) -> tuple[Stretch, ...]:
    """Return stretches that begin in the state in which this model fits them best."""
    return tuple(replace(s, start=start_of(model, s, PREDICTION_STEP)) for s in stretches)
