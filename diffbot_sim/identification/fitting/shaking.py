"""Fits shaken out of local minima: whether a wheel breaks away is a jump that errors hang on.

In the moment at which an effect sets in the error is a staircase with hollows, too.
"""

from collections.abc import Iterator, Sequence
from functools import partial
from itertools import product

import numpy as np

from diffbot_sim.identification.fitting.fit import (
    FIRST_GAINS,
    Fit,
    fit_prediction,
    fit_with_noise_held,
)
from diffbot_sim.identification.statistics.parallel import side_by_side
from diffbot_sim.records import Array

# What decides whether a wheel breaks away or sticks, and how far it is moved, in its coordinate.
SHAKEN, KICK = ('mu_coulomb', 'mu_static'), 0.15
# How far a moment is moved, either way [s].
MOVED = (0.4, 1.2)
# A noise model that hears every error: one that hears little may never find a disturbance that is
# far stronger than the noise.
QUICK_GAINS = np.array([0.9, 0.5, 0.5, 0.9, 0.5, 0.5])
# Evaluations after which the best of the starts beside a minimum is chosen, to be followed.
SHORT = 4
# A fall of the deviance below this is none; so many times is a lower minimum looked for.
LOWER, ROUNDS = 1.0, 4


def shaken(fit: Fit) -> Fit:
    """Fit again from other noise models, then from points beside while that leads lower."""
    again = partial(fit_prediction, fit.space, fit.stretches, fit.u)
    fit = _lower_of(fit, _lowest(fit, side_by_side(again, (FIRST_GAINS, QUICK_GAINS))))
    for _ in range(ROUNDS):
        nearby = side_by_side(partial(_approach, fit), _beside(fit))
        near = _lowest(fit, nearby)
        end = _lower_of(fit, fit_prediction(fit.space, fit.stretches, near.u, fit.gains))
        if end is fit:
            break
        fit = end
    return fit


def _lowest(fit: Fit, ends: Sequence[Fit]) -> Fit:
    """Return the lowest of the ends of a fit, the fit itself where there is none."""
    return min(ends, key=lambda end: end.deviance(fit.sigma), default=fit)


def _lower_of(fit: Fit, end: Fit) -> Fit:
    """Return the fit, or its other end if that is truly lower."""
    return end if fit.deviance(fit.sigma) - end.deviance(fit.sigma) >= LOWER else fit


def _approach(fit: Fit, start: Array) -> Fit:
    return fit_with_noise_held(fit.space, fit.stretches, start, fit.gains, SHORT, rounds=1)


def _beside(fit: Fit) -> Iterator[Array]:
    """Yield points of other friction at rest, and of other moments."""
    at_rest = product(fit.space.where(SHAKEN), (KICK,))
    sizes = [*at_rest, *product(fit.space.onsets, MOVED)]
    for (index, size), way in product(sizes, (1.0, -1.0)):
        beside = fit.u.copy()
        beside[index] += way * size
        yield beside
