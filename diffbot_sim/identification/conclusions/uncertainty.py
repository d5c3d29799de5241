"""Intervals: from fits that lack a block of the run each; of moments and periods by profiles."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from diffbot_sim.identification.fitting.coordinates import Coordinate, Space
from diffbot_sim.identification.fitting.fit import GAIN_LIMITS, Fit
from diffbot_sim.identification.result import Estimate
from diffbot_sim.identification.statistics.blocks import BLOCKS, jackknife
from diffbot_sim.records import Array

LEVEL = 0.95
STEP = 1e-4
QUANTILE = float(stats.t.ppf(0.5 + LEVEL / 2, BLOCKS - 1))
# The first step of a search for where an interval ends, and how it grows.
FIRST_STEP, GROWTH = 1e-4, 1.4
# What chance allows the deviance to rise by; the search ends at so many times that.
CHANCE, BEYOND = QUANTILE**2, 4.0
HALVINGS = 5
# Steps by which all other coordinates follow one along its profile.
ADAPTATIONS = 3
# Coordinates are of order one; fits end a little inside their bounds.
NEAR_BOUND = 1e-3


def estimates(fit: Fit) -> dict[str, Estimate]:
    """Return every fitted parameter by its name, with its 95 % interval."""
    free = _free(fit)
    spread = jackknife(fit.jacobian[..., free], fit.whitened, fit.prior_information[free])
    found = estimates_at(fit.space, fit.u, spread)
    for index in fit.space.shapes:
        coordinate = fit.space.coordinates[index]
        profile, best = _Profile(fit, index), float(fit.u[index])
        ends = (farthest(profile.rise, best, bound[index]) for bound in fit.space.bounds())
        low, high = sorted(map(coordinate.value, ends))
        known = found[coordinate.name]
        if fit.runs_free:  # its errors last, and allow more than white ones
            low, high = min(low, known.low), max(high, known.high)
        found[coordinate.name] = replace(known, low=low, high=high)
    return found


def _free(fit: Fit) -> NDArray[np.intp]:
    """Return which numbers were fitted: all of u, and the gains but in a fit by simulation."""
    return np.arange(len(fit.u) if fit.runs_free else len(fit.u) + len(fit.gains))


def farthest(rise: Callable[[float], float], best: float, bound: float) -> float:
    """Return the farthest value that chance allows on the way from the best one to a bound.

    rise: by how much the deviance is higher at a value than at the best one. A moment or a period
    has no slope to speak of, since the error is a staircase in it, with hollows; so the search
    goes on beyond the first step that is too high.
    """
    way, step, values, rises = abs(bound - best), FIRST_STEP, [best], [0.0]
    while rises[-1] < BEYOND * CHANCE and step < GROWTH * way:
        values.append(best + float(np.copysign(min(step, way), bound - best)))
        rises.append(rise(values[-1]))
        step *= GROWTH
    last = max(index for index, higher in enumerate(rises) if higher < CHANCE)
    within, beyond = values[last], values[min(last + 1, len(values) - 1)]
    for _ in range(HALVINGS):
        middle = 0.5 * (within + beyond)
        if rise(middle) < CHANCE:
            within = middle
        else:
            beyond = middle
    return within


class _Profile:
    """The deviance of a fit along one coordinate, while all others adapt.

    Remembers where they went for values nearby: an amount may have to follow its time constant
    far, on a curve.
    """

    def __init__(self, fit: Fit, index: int) -> None:
        self._fit, self._index, self._known = fit, index, [fit]
        self._others = np.delete(_free(fit), index)
        slopes = fit.jacobian[..., self._others].reshape(fit.whitened.size, -1)
        self._shift = -np.linalg.pinv(slopes, rcond=1e-8)

    def rise(self, value: float) -> float:
        """Return by how much the deviance is higher than at the fit."""
        index, sigma = self._index, self._fit.sigma
        nearest = min(self._known, key=lambda known: abs(float(known.u[index]) - value))
        u = nearest.u.copy()
        u[index] = value
        tried = [replace(nearest, u=u)]
        for _ in range(ADAPTATIONS):
            tried.append(self._adapted(tried[-1]))
        best = min(tried, key=lambda fit: fit.deviance(sigma))
        self._known.append(best)
        return best.deviance(sigma) - self._fit.deviance(sigma)

    def _adapted(self, moved: Fit) -> Fit:
        """Return a step towards where the others lower the error most, by the fit's own slopes."""
        change = (moved.whitened - self._fit.whitened).ravel()
        point = np.concatenate([moved.u, moved.gains])
        point[self._others] += self._shift @ change
        u, gains = np.split(point, [len(moved.u)])
        bounds = self._fit.space.bounds()
        return replace(moved, u=np.clip(u, *bounds), gains=np.clip(gains, *GAIN_LIMITS))


def estimates_at(space: Space, u: Array, spread: Array) -> dict[str, Estimate]:
    """Return the parameters at a point; spread: covariance of u and whatever follows it."""
    values = space.values(u)
    names = list(values)
    size = len(u)
    derivative = np.empty((len(names), size))
    for index in range(size):
        moved = u.copy()
        moved[index] += STEP
        shifted = space.values(moved)
        derivative[:, index] = [(shifted[name] - values[name]) / STEP for name in names]
    own = derivative @ spread[:size, :size] @ derivative.T
    reach = QUANTILE * np.sqrt(np.maximum(np.diag(own), 0.0))
    middle = np.array(list(values.values()))
    lowest, highest = np.transpose([coordinate.valid for coordinate in space.coordinates])
    lows, highs = (np.clip(ends, lowest, highest) for ends in (middle - reach, middle + reach))
    for index, coordinate in enumerate(space.coordinates):
        if coordinate.reciprocal:  # beyond any size it may be as good as none
            far = QUANTILE * float(np.sqrt(spread[index, index]))
            lows[index], highs[index] = _reciprocal_ends(coordinate, float(u[index]), far)
    facts = zip(space.coordinates, lows, highs, at_bound(space, u), strict=True)
    return {
        it.name: Estimate(values[it.name], float(low), float(high), it.unit, bool(stopped))
        for it, low, high, stopped in facts
    }


def _reciprocal_ends(coordinate: Coordinate, at: float, reach: float) -> tuple[float, float]:
    """Return the lowest and highest value of a parameter whose coordinate is known so well."""
    ends = np.clip([at - reach, at + reach], coordinate.low, coordinate.high)
    highest, lowest = map(coordinate.value, ends.tolist())
    return lowest, highest


def at_bound(space: Space, u: Array) -> Array:
    """Return which coordinates lie at their lowest or highest valid value."""
    low, high = space.bounds()
    return np.asarray(np.minimum(u - low, high - u) < NEAR_BOUND)
