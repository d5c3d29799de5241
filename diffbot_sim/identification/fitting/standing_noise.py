"""The colour of the noise of a robot that stands, where nothing but its odometry tells."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from scipy.optimize import least_squares
from scipy.signal import lfilter

from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.fitting.predictor import NO_GAIN, predict
from diffbot_sim.identification.recordings.filters import Filter, as_let_through
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.statistics.guards import VERY_STRONG
from diffbot_sim.physics.model import Model
from diffbot_sim.records import Array

# So long after a stop [s] nothing of the motion is left in a filter; what is shorter than so many
# samples tells nothing.
COASTING, SHORTEST = 0.3, 15
# Samples at the beginning of a rest that are left out, where what was before is not known.
UNKNOWN = 5
# A robot whose twists are spread by more than so many times what is usual at rest does move.
MOVING = 2.0
# Where fits of a colour begin: a lag, a slow oscillation, one behind a mean of three samples.
STARTS = ((-0.5, 0.1, 0.0, 0.0), (-2.0, 1.0, 0.0, 0.0), (-1.5, 0.5, 0.8, 0.5))
EVALUATIONS = 60
# The number that stands for no colour.
WHITE = np.zeros(1)
# No root is nearer to the circle where a filter never forgets.
NEAREST = 0.995


class Rest(NamedTuple):
    """Where a robot stands: the number of the stretch, and its samples there."""

    stretch: int
    samples: slice


class Colour(NamedTuple):
    """What makes the noise white again: past / given; worth: by so much -2 log-likelihood falls.

    point: four numbers that stand for both, without bounds.
    """

    point: Array
    worth: float


def polynomials(point: Array) -> tuple[Array, Array]:
    """Return what up to four numbers stand for: past and given, shape (3,), that forget.

    Those that are left out are 0: of one number it is a colour of first order.
    """
    reflected = NEAREST * np.tanh(np.pad(point, (0, 4 - len(point))))
    return _stable(reflected[:2]), _stable(reflected[2:])


def first_order(delay: float) -> Array:
    """Return the number that stands for a filter of first order, of a delay in samples, (1,)."""
    return np.arctanh([-delay / (1.0 + delay)])


def rests_of(fit: Fit) -> list[Rest]:
    """Return where the robot stands by a model that runs free, but where its twists deny that."""
    rests = [Rest(k, at) for k, s in enumerate(fit.stretches) for at in _rests(fit.model, s)]
    if not rests:
        return []
    noise = standing_noise(fit.stretches, rests)
    spread = np.array([piece.std(axis=0) for piece in noise])
    usual = np.median(np.repeat(spread, [len(piece) for piece in noise], axis=0), axis=0)
    steady = np.all(spread <= MOVING * usual, axis=1)
    return [rest for rest, stands in zip(rests, steady, strict=True) if stands]


def standing_noise(stretches: Sequence[Stretch], rests: Sequence[Rest]) -> list[Array]:
    """Return the twists (k, 2) of each rest about their mean."""
    pieces = [stretches[rest.stretch].twist[rest.samples] for rest in rests]
    return [piece - piece.mean(axis=0) for piece in pieces]


def colour_of(noise: Sequence[Array]) -> Colour:
    """Return the colour of second order that explains the noise of a robot that stands best."""
    deviation = np.concatenate(noise).std(axis=0)

    def errors(point: Array) -> Array:
        past, given = polynomials(point)
        white = [lfilter(past, given, piece / deviation, axis=0)[UNKNOWN:] for piece in noise]
        return np.concatenate(white).ravel()

    ends = [least_squares(errors, start, max_nfev=EVALUATIONS) for start in STARTS]
    best = min(ends, key=lambda end: float(end.cost))
    fall = np.log(np.mean(errors(WHITE) ** 2) / np.mean(best.fun**2))
    return Colour(best.x, float(len(best.fun) * fall))


def worth_of(noise: Sequence[Array], white: Sequence[Array]) -> float:
    """Return by how much -2 log-likelihood of noise falls if what is left of it is white."""
    before, after = (np.concatenate(pieces).var(axis=0) for pieces in (noise, white))
    return float(sum(map(len, noise)) * np.log(before / after).sum())


def denied_at_rest(fit: Fit, behind: Filter) -> bool:
    """Say whether the noise of a robot that stands did not go through a filter."""
    rests = rests_of(fit)
    noise = standing_noise(fit.stretches, rests)
    if tells_nothing(noise):
        return False
    new = standing_noise([as_let_through(s, behind) for s in fit.stretches], rests)
    return worth_of(noise, new) < -VERY_STRONG


def tells_nothing(noise: Sequence[Array]) -> bool:
    """Say whether there is no noise, of speed or turn rate, to tell anything by."""
    return not noise or bool(np.any(np.concatenate(noise).std(axis=0) == 0.0))


def _rests(model: Model, stretch: Stretch) -> list[slice]:
    still = np.all(predict(model, stretch, NO_GAIN).twist == 0.0, axis=1)
    moved = np.maximum.accumulate(np.where(still, -np.inf, stretch.time))
    resting = still & (stretch.time > moved + COASTING)
    ends = np.flatnonzero(np.diff(np.concatenate([[0], resting, [0]])))
    return [slice(begin, end) for begin, end in ends.reshape(-1, 2) if end - begin >= SHORTEST]


def _stable(reflected: Array) -> Array:
    """Return the polynomial of two reflection coefficients between -1 and 1: it is stable."""
    first, second = reflected
    return np.array([1.0, first * (1.0 + second), second])
