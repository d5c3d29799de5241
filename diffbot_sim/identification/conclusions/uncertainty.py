"""Intervals: from fits that lack a block of the run each; of moments and periods by profiles.

Both are wider where the way itself is uncertain that effects hang on.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from diffbot_sim.identification.conclusions.wandering import wandering
from diffbot_sim.identification.fitting.coordinates import Coordinate, Space
from diffbot_sim.identification.fitting.fit import GAIN_LIMITS, Fit
from diffbot_sim.identification.result import Estimate
from diffbot_sim.identification.statistics.blocks import BLOCKS, jackknife
from diffbot_sim.records import Array

LEVEL = 0.95
STEP = 1e-4
# Errors of a simulation last: of a rough floor's, 40 blocks are not independent. Intervals of the
# mass and inertia of 24 robots there held the truth in 38 of 48 cases, by 8 blocks in 43.
BLOCKS_OF_SIMULATION = 8
# The first step of a search for where an interval ends, and how it grows.
FIRST_STEP, GROWTH = 1e-4, 1.4
HALVINGS = 5
# Steps by which all other coordinates follow one along its profile.
ADAPTATIONS = 3
# Coordinates are of order one; fits end a little inside their bounds.
NEAR_BOUND = 1e-3


def quantile(blocks: int) -> float:
    """Return how many deviations an interval reaches, by a spread over so many blocks."""
    return float(stats.t.ppf(0.5 + LEVEL / 2, blocks - 1))


# What chance allows the deviance to rise by; the search ends at so many times that.
CHANCE, BEYOND = quantile(BLOCKS) ** 2, 4.0


def estimates(fit: Fit) -> dict[str, Estimate]:
    """Return every fitted parameter by its name, with its 95 % interval."""
    free = _free(fit)
    blocks = BLOCKS_OF_SIMULATION if fit.runs_free else BLOCKS
    known = fit.prior_information[free]
    slopes = fit.jacobian[..., free]
    # Its profile tells a moment; without the block that holds it, it might be anywhere.
    slopes[..., fit.space.onsets] = 0.0
    spread = jackknife(slopes, fit.whitened, known, blocks)
    of_the_way = wandering(fit, slopes)
    found = estimates_at(fit.space, fit.u, spread + of_the_way, blocks)
    lasting = _lasting(fit, spread) if fit.runs_free else 1.0
    for index in fit.space.shapes:
        coordinate = fit.space.coordinates[index]
        rise, best = _Profile(fit, index, lasting).rise, float(fit.u[index])
        astray = quantile(blocks) * float(np.sqrt(of_the_way[index, index]))
        ends = (
            farther(farthest(rise, best, bound[index]), best, astray, bound[index])
            for bound in fit.space.bounds()
        )
        low, high = sorted(map(coordinate.value, ends))
        found[coordinate.name] = replace(found[coordinate.name], low=low, high=high)
    return found


def _free(fit: Fit) -> NDArray[np.intp]:
    """Return which numbers were fitted: all of u, and the gains but in a fit by simulation."""
    return np.arange(len(fit.u) if fit.runs_free else len(fit.u) + len(fit.gains))


def _lasting(fit: Fit, spread: Array) -> float:
    """Return how many times as uncertain all is, in the median, as by independent errors."""
    slopes = fit.slopes[:, : len(fit.u)]
    known = slopes.T @ slopes + np.diag(fit.prior_information[: len(fit.u)])
    return max(1.0, float(np.median(np.diag(spread) / np.diag(np.linalg.inv(known)))))


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


def farther(end: float, best: float, astray: float, bound: float) -> float:
    """Return where an interval ends that errors of another origin reach so far beyond the best."""
    reach = min(float(np.hypot(end - best, astray)), abs(bound - best))
    return best + float(np.copysign(reach, bound - best))


class _Profile:
    """The deviance of a fit along one coordinate, while all others adapt.

    Remembers where they went for values nearby: an amount may have to follow its time constant
    far, on a curve. lasting: by how much less the deviance counts, since errors last.
    """

    def __init__(self, fit: Fit, index: int, lasting: float) -> None:
        self._fit, self._index, self._known, self._lasting = fit, index, [fit], lasting
        self._others = np.delete(_free(fit), index)
        self._shift = -np.linalg.pinv(fit.slopes[:, self._others], rcond=1e-8)

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
        return (best.deviance(sigma) - self._fit.deviance(sigma)) / self._lasting

    def _adapted(self, moved: Fit) -> Fit:
        """Return a step towards where the others lower the error most, by the fit's own slopes."""
        change = (moved.whitened - self._fit.whitened).ravel()
        point = moved.point
        point[self._others] += self._shift @ change
        u, gains = np.split(point, [len(moved.u)])
        bounds = self._fit.space.bounds()
        return replace(moved, u=np.clip(u, *bounds), gains=np.clip(gains, *GAIN_LIMITS))


def estimates_at(
    space: Space, u: Array, spread: Array, blocks: int = BLOCKS
) -> dict[str, Estimate]:
    """Return the parameters at a point.

    spread: covariance of u and whatever follows it, by so many blocks.
    """
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
    reach = quantile(blocks) * np.sqrt(np.maximum(np.diag(own), 0.0))
    middle = np.array(list(values.values()))
    lowest, highest = np.transpose([coordinate.valid for coordinate in space.coordinates])
    lows, highs = (np.clip(ends, lowest, highest) for ends in (middle - reach, middle + reach))
    for index, coordinate in enumerate(space.coordinates):
        if coordinate.reciprocal:  # beyond any size it may be as good as none
            far = quantile(blocks) * float(np.sqrt(spread[index, index]))
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
