"""Fits: robust least squares on whitened prediction errors, noise model included."""

from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cached_property
from os import cpu_count
from typing import NamedTuple, TypeVar

import numpy as np
from scipy.optimize import least_squares

from diffbot_sim.identification.coordinates import PRIOR_DEVIATION, Space
from diffbot_sim.identification.predictor import NO_GAIN, Prediction, predict
from diffbot_sim.identification.stretches import Stretch
from diffbot_sim.physics.model import Model
from diffbot_sim.records import Array

# Where fits of the noise model start, and how far its gains may go: speed, disturbance, memory.
FIRST_GAINS = np.array([0.05, 0.005, 0.3, 0.05, 0.005, 0.3])
GAIN_LIMITS = (np.zeros(6), np.array([0.95, 0.5, 0.999, 0.95, 0.5, 0.999]))
GAIN_PRIOR = np.array([0.0, 0.0, 0.3, 0.0, 0.0, 0.3])
# Beyond this many standard deviations an error counts linearly: events cannot dominate.
HUBER = 3.0
# An error that is as bad as any.
WORST = 1e9
# Step of finite differences, in coordinates of order one.
DIFFERENCE = 1e-5
# A scale that changes by less than this share between two rounds has settled.
SETTLED = 0.002
Errors = Callable[[Array, Array], Array]
Item = TypeVar('Item')
Result = TypeVar('Result')
_POOL = ThreadPoolExecutor(max_workers=cpu_count())


class Prior(NamedTuple):
    """Where coordinates are pulled to, and how weakly."""

    centre: Array
    deviation: Array


@dataclass(frozen=True)
class Fit:
    """A fitted structure.

    u: point in space; gains, shape (6,); sigma: scale of the innovations in v and ω, shape (2,).
    """

    space: Space
    stretches: tuple[Stretch, ...]
    u: Array
    gains: Array
    sigma: Array

    @cached_property
    def model(self) -> Model:
        """The model at the fitted point."""
        return self.space.model(self.u)

    @cached_property
    def whitened(self) -> Array:
        """Innovations of all stretches over sigma, shape (n, 2)."""
        return whitened(self.stretches, self.model, self.gains, self.sigma)

    def deviance(self, sigma: Array) -> float:
        """Return twice the robust cost at a given scale."""
        return float(huber(self.whitened * (self.sigma / sigma)).sum())

    @cached_property
    def jacobian(self) -> Array:
        """Derivative of whitened by u and then the gains, shape (n, 2, p)."""
        return self.jacobian_on(self.stretches)

    def jacobian_on(self, stretches: Sequence[Stretch]) -> Array:
        """Return the same derivative on other stretches."""
        size = len(self.u)

        def errors(point: Array) -> Array:
            return whitened(stretches, self.space.model(point[:size]), point[size:], self.sigma)

        point = np.concatenate([self.u, self.gains])
        return np.stack(_columns(errors, point, errors(point)), axis=-1)


def each(work: Callable[[Item], Result], items: Iterable[Item]) -> list[Result]:
    """Return work done on every item, on all cores; work must not call this itself."""
    return list(_POOL.map(work, items))


def huber(errors: Array) -> Array:
    """Return the robust squares of whitened errors."""
    size = np.abs(errors)
    return np.where(size <= HUBER, size**2, 2.0 * HUBER * size - HUBER**2)


def influence(errors: Array) -> Array:
    """Return how much whitened errors count in robust sums: the derivative of huber, halved."""
    return np.clip(errors, -HUBER, HUBER)


def whitened(
    stretches: Sequence[Stretch],
    model: Model,
    gains: Array,
    sigma: Array,
    pushes: Sequence[Array] | None = None,
) -> Array:
    """Return used innovations of several stretches, one after the other, over sigma: (n, 2)."""
    rows = []
    for index, stretch in enumerate(stretches):
        push = None if pushes is None else pushes[index]
        innovation = predict(model, stretch, gains, push).innovation
        used = (innovation * stretch.used[:, None])[stretch.used > 0]
        # Parameters far from any robot make numbers that cannot be squared: these only have to
        # be bad.
        rows.append(np.clip(used, -WORST * sigma, WORST * sigma) / sigma)
    return np.nan_to_num(np.concatenate(rows), nan=WORST)


def predictions(fit: Fit, stretches: Sequence[Stretch]) -> list[Prediction]:
    """Return the one-step predictions of a fit on any stretches."""
    return [predict(fit.model, stretch, fit.gains) for stretch in stretches]


def scale_of(errors: Array) -> Array:
    """Return robust standard deviations of the columns; never zero."""
    middle = np.median(np.abs(errors), axis=0) * 1.4826
    plain = np.sqrt(np.mean(np.clip(errors, -5 * middle - 1e-12, 5 * middle + 1e-12) ** 2, axis=0))
    return np.maximum(np.where(plain > 0, plain, 1e-9), 1e-9)


def fit_simulation(
    space: Space, stretches: tuple[Stretch, ...], start: Array, evaluations: int = 25
) -> Fit:
    """Fit by simulation error (output error): gains 0."""
    return fit_with_noise_held(space, stretches, start, NO_GAIN, evaluations)


def fit_with_noise_held(
    space: Space,
    stretches: tuple[Stretch, ...],
    start: Array,
    gains: Array,
    evaluations: int = 12,
    rounds: int = 2,
) -> Fit:
    """Fit the parameters alone, the noise model as it is given."""

    def errors(at: Array, sigma: Array) -> Array:
        return whitened(stretches, space.model(at), gains, sigma)

    prior = Prior(space.prior(), space.deviations())
    point, sigma = _minimise(errors, start, prior, space.bounds(), evaluations, rounds)
    return Fit(space, stretches, point, gains, sigma)


def fit_prediction(
    space: Space,
    stretches: tuple[Stretch, ...],
    start: Array,
    gains: Array,
    evaluations: int = 20,
    rounds: int = 3,
) -> Fit:
    """Fit parameters and noise model together by one-step prediction error."""
    size = len(start)

    def errors(at: Array, sigma: Array) -> Array:
        return whitened(stretches, space.model(at[:size]), at[size:], sigma)

    low, high = space.bounds()
    bounds = (np.concatenate([low, GAIN_LIMITS[0]]), np.concatenate([high, GAIN_LIMITS[1]]))
    prior = Prior(
        np.concatenate([space.prior(), GAIN_PRIOR]),
        np.concatenate([space.deviations(), np.full(len(gains), PRIOR_DEVIATION)]),
    )
    begin = np.concatenate([start, gains])
    point, sigma = _minimise(errors, begin, prior, bounds, evaluations, rounds)
    return Fit(space, stretches, point[:size], point[size:], sigma)


def _minimise(
    errors: Errors,
    start: Array,
    prior: Prior,
    bounds: tuple[Array, Array],
    evaluations: int,
    rounds: int,
) -> tuple[Array, Array]:
    """Alternate robust least squares and the scale of the errors; return point and scale."""
    low, high = bounds
    margin = 1e-9 * np.maximum(1.0, np.abs(start))
    point = np.clip(start, low + margin, high - margin)
    sigma = scale_of(errors(point, np.ones(2)))
    for _ in range(rounds):
        point = _least_squares(errors, point, prior, bounds, sigma, evaluations)
        fresh = scale_of(errors(point, np.ones(2)))
        settled = bool(np.all(np.abs(fresh / sigma - 1.0) < SETTLED))
        sigma = fresh
        if settled:
            break
    return point, sigma


def _least_squares(
    errors: Errors,
    start: Array,
    prior: Prior,
    bounds: tuple[Array, Array],
    sigma: Array,
    evaluations: int,
) -> Array:
    """Minimise robust whitened errors, with a weak pull towards the prior."""

    def cost(at: Array) -> Array:
        return np.concatenate([errors(at, sigma).ravel(), (at - prior.centre) / prior.deviation])

    def jacobian(at: Array) -> Array:
        columns = _columns(lambda x: errors(x, sigma), at, errors(at, sigma))
        stacked = np.stack([column.ravel() for column in columns], axis=1)
        return np.vstack([stacked, np.diag(1.0 / prior.deviation)])

    result = least_squares(
        cost,
        start,
        jac=jacobian,
        bounds=bounds,
        loss='huber',
        f_scale=HUBER,
        x_scale='jac',
        max_nfev=evaluations,
        ftol=1e-6,
        xtol=1e-6,
    )
    return np.asarray(result.x)


def _columns(errors: Callable[[Array], Array], at: Array, base: Array) -> list[Array]:
    """Return derivatives by forward differences, one column a coordinate, on all cores."""

    def column(index: int) -> Array:
        moved = at.copy()
        moved[index] += DIFFERENCE
        return np.asarray((errors(moved) - base) / DIFFERENCE)

    return each(column, range(len(at)))
