"""Robust least squares with a weak prior; parameters and the scale of errors settle in turn."""

from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np
from scipy.optimize import least_squares

from diffbot_sim.identification.statistics.parallel import each
from diffbot_sim.identification.statistics.robust import HUBER, huber, scale_of
from diffbot_sim.records import Array

# Step of finite differences, in coordinates of order one.
DIFFERENCE = 1e-5
# A slope so many times as steep as all but a hundredth may be a jump: a wheel just breaks away.
JUMP, ALL_BUT = 30.0, 0.99
# A scale that changes by less than this share between two rounds has settled. Where errors jump a
# round may end at no minimum: if the cost falls by less than this there is none lower near.
SETTLED, LOWER = 0.002, 0.03
# A round ends where its cost falls by less than this share.
SLIGHTEST = 1e-5
# No odometry tells speeds [m/s] and yaw rates [rad/s] more finely, nor are integrators of others
# closer: what is smaller is no error.
FINEST = 1e-4
# Errors (n, 2) at a point (p,).
Errors = Callable[[Array], Array]
# Lowest and highest coordinates, each of shape (p,).
Bounds = tuple[Array, Array]


class Prior(NamedTuple):
    """Where coordinates are pulled to, and how weakly."""

    centre: Array
    deviation: Array


def derivatives(errors: Errors, at: Array, base: Array, bounds: Bounds) -> Array:
    """Return derivatives of errors by differences within bounds, on all cores, shape (n, 2, p).

    Where a slope may be a jump, both sides are looked at.
    """
    low, high = bounds

    def column(index: int) -> Array:
        one, *other = (
            partial(difference, errors, at, base, index, step)
            for step in (DIFFERENCE, -DIFFERENCE)
            if low[index] <= at[index] + step <= high[index]
        )
        slopes = one()
        return flatter(slopes, other[0]()) if other and _may_jump(slopes) else slopes

    return np.stack(each(column, range(len(at))), axis=-1)


def _may_jump(slopes: Array) -> bool:
    """Say whether a few slopes are so much steeper than nearly all that they may be jumps."""
    size = np.abs(slopes)
    near = np.count_nonzero(JUMP * size >= size.max())
    return bool(near < (1.0 - ALL_BUT) * size.size)


def difference(errors: Errors, at: Array, base: Array, index: int, step: float) -> Array:
    """Return by how much errors change with one coordinate, per unit of it, shape (n, 2)."""
    moved = at.copy()
    moved[index] += step
    return np.asarray((errors(moved) - base) / step)


def slope(errors: Errors, at: Array, base: Array, index: int, step: float, lowest: float) -> Array:
    """Return a slope by differences, the flatter one of both sides where both are valid."""
    one_side = partial(difference, errors, at, base, index)
    if at[index] - step < lowest:
        return one_side(step)
    return flatter(one_side(step), one_side(-step))


def flatter(one: Array, other: Array) -> Array:
    """Return at each sample the flatter of its slopes on both sides of a point.

    Errors jump where the least change decides whether a wheel breaks away. A jump lies on one
    side and is no slope: one such sample would outweigh all the rest.
    """
    return np.where(np.abs(one) <= np.abs(other), one, other)


def minimise(
    errors: Errors,
    start: Array,
    prior: Prior,
    bounds: Bounds,
    evaluations: int,
    rounds: int,
) -> tuple[Array, Array]:
    """Alternate robust least squares and the scale of the errors; return point and scale."""
    low, high = bounds
    inside, known = np.clip(start, low, high), _Remembered(errors, bounds)
    margin = 1e-9 * np.maximum(1.0, np.abs(inside))
    point = np.clip(inside, low + margin, high - margin)
    sigma = scale(known.errors(point))
    for _ in range(rounds):
        point, lowest = _least_squares(known, point, prior, bounds, sigma, evaluations)
        last, sigma = sigma, scale(known.errors(point))
        if lowest and np.all(np.abs(sigma / last - 1.0) < SETTLED):
            break
    return point, sigma


def scale(errors: Array) -> Array:
    """Return the robust scale of errors, shape (2,), no finer than any can be."""
    return np.asarray(np.maximum(scale_of(errors), FINEST))


class _Remembered:
    """Errors and their derivatives where they were asked for last: that is often asked again."""

    def __init__(self, errors: Errors, bounds: Bounds) -> None:
        self._errors, self._bounds = errors, bounds
        self._at = self._linear_at = np.array([np.nan])
        self._values = self._slopes = np.empty(0)

    def errors(self, at: Array) -> Array:
        """Return the errors, shape (n, 2)."""
        if not np.array_equal(at, self._at):
            self._at, self._values = at.copy(), self._errors(at)
        return self._values

    def derivatives(self, at: Array) -> Array:
        """Return their derivatives, shape (n, 2, p)."""
        if not np.array_equal(at, self._linear_at):
            self._slopes = derivatives(self._errors, at, self.errors(at), self._bounds)
            self._linear_at = at.copy()
        return self._slopes

    def latest(self) -> Array:
        """Return the derivatives where they were asked for last."""
        return self._slopes


class _Descent:
    """What a minimisation asks for, with the scale held.

    It asks for derivatives where it ends, too. No step follows there, so that it is told the
    latest ones: whoever sets out from there anew asks again.
    """

    def __init__(self, known: _Remembered, prior: Prior, sigma: Array, evaluations: int) -> None:
        self._known, self._prior, self._sigma = known, prior, sigma
        self._left, self._lowest = evaluations, np.inf

    def residuals(self, at: Array) -> Array:
        """Return whitened errors, and behind them how far coordinates are from the prior."""
        self._left -= 1
        return self._residuals(at)

    def cost(self, at: Array) -> float:
        """Return twice the robust cost."""
        return float(huber(self._residuals(at)).sum())

    def jacobian(self, at: Array) -> Array:
        """Return the derivatives of the residuals."""
        before, self._lowest = self._lowest, self.cost(at)
        ends = before < np.inf and (self._left == 0 or before - self._lowest < SLIGHTEST * before)
        slopes = self._known.latest() if ends else self._known.derivatives(at)
        whitened = (slopes / self._sigma[:, None]).reshape(-1, len(at))
        return np.vstack([whitened, np.diag(1.0 / self._prior.deviation)])

    def _residuals(self, at: Array) -> Array:
        whitened = self._known.errors(at) / self._sigma
        away = (at - self._prior.centre) / self._prior.deviation
        return np.concatenate([whitened.ravel(), away])


def _least_squares(
    known: _Remembered,
    start: Array,
    prior: Prior,
    bounds: Bounds,
    sigma: Array,
    evaluations: int,
) -> tuple[Array, bool]:
    """Minimise robust whitened errors; return the point, and whether nothing near is lower."""
    descent = _Descent(known, prior, sigma, evaluations)
    first = descent.cost(start)
    result = least_squares(
        descent.residuals,
        start,
        jac=descent.jacobian,
        bounds=bounds,
        loss='huber',
        f_scale=HUBER,
        x_scale='jac',
        max_nfev=evaluations,
        ftol=SLIGHTEST,
        xtol=1e-6,
    )
    lowest = result.status > 0 or first - huber(result.fun).sum() < LOWER
    return np.asarray(result.x), bool(lowest)
