"""Intervals: covariance of the fit over blocks of the run, carried over to parameters."""

from dataclasses import replace

import numpy as np
from scipy import stats

from diffbot_sim.identification.coordinates import Space
from diffbot_sim.identification.evidence import BLOCKS, jackknife
from diffbot_sim.identification.fitting import Fit
from diffbot_sim.identification.result import Estimate
from diffbot_sim.records import Array

LEVEL = 0.95
STEP = 1e-4
QUANTILE = float(stats.t.ppf(0.5 + LEVEL / 2, BLOCKS - 1))
# The first step of a search for where an interval ends, and how it grows.
FIRST_STEP, GROWTH = 1e-4, 1.5
# Coordinates are of order one; fits end a little inside their bounds.
NEAR_BOUND = 1e-3


def estimates(fit: Fit) -> dict[str, Estimate]:
    """Return every fitted parameter by its name, with its 95 % interval."""
    spread = jackknife(fit)
    for index in fit.space.shapes:
        spread[index, index] = max(spread[index, index], (_reach(fit, index) / QUANTILE) ** 2)
    return estimates_at(fit.space, fit.u, spread)


def _reach(fit: Fit, index: int) -> float:
    """Return how far a coordinate may move until the likelihood falls by what chance allows.

    A moment has no slope to speak of: the error is a staircase in it, finer than its interval.
    """
    base, bounds = fit.deviance(fit.sigma), [bound[index] for bound in fit.space.bounds()]
    reaches = []
    for side in (-1.0, 1.0):
        step = FIRST_STEP
        while bounds[0] < fit.u[index] + side * step < bounds[1]:
            moved = fit.u.copy()
            moved[index] += side * step
            if replace(fit, u=moved).deviance(fit.sigma) > base + QUANTILE**2:
                break
            step *= GROWTH
        reaches.append(step)
    return float(np.mean(reaches))


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
    units = {coordinate.name: coordinate.unit for coordinate in space.coordinates}
    stopped = dict(zip(names, at_bound(space, u), strict=True))
    return {
        name: Estimate(
            value=values[name],
            low=values[name] - float(half),
            high=values[name] + float(half),
            unit=units[name],
            at_bound=bool(stopped[name]),
        )
        for name, half in zip(names, reach, strict=True)
    }


def at_bound(space: Space, u: Array) -> Array:
    """Return which coordinates lie at their lowest or highest valid value."""
    low, high = space.bounds()
    return np.asarray(np.minimum(u - low, high - u) < NEAR_BOUND)
