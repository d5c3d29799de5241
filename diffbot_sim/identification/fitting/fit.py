"""Fits: robust least squares on whitened prediction errors, noise model included."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from diffbot_sim.identification.fitting.coordinates import PRIOR_DEVIATION, Space
from diffbot_sim.identification.fitting.predictor import NO_GAIN, Prediction, predict
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.statistics.minimisation import Prior, derivatives, minimise
from diffbot_sim.identification.statistics.robust import huber
from diffbot_sim.physics.model import Model
from diffbot_sim.records import Array

# Where fits of the noise model start, and how far its gains may go: speed, disturbance, memory.
FIRST_GAINS = np.array([0.05, 0.005, 0.3, 0.05, 0.005, 0.3])
GAIN_LIMITS = (np.zeros(6), np.array([0.95, 0.5, 0.999, 0.95, 0.5, 0.999]))
GAIN_PRIOR = np.array([0.0, 0.0, 0.3, 0.0, 0.0, 0.3])
# Evaluations in a round, and rounds at most, of fits that go on to the end.
EVALUATIONS, ROUNDS = 10, 8
# An error [m/s, rad/s] that is as bad as any.
WORST = 1e9


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

    @property
    def runs_free(self) -> bool:
        """Whether nothing corrects its model: it was fitted by simulation error."""
        return not np.any(self.gains)

    @property
    def incredible(self) -> frozenset[str]:
        """The effects to which it gives values that no robot has."""
        return frozenset(e.name for e in self.model.effects if not e.is_credible)

    @cached_property
    def whitened(self) -> Array:
        """Innovations of all stretches over sigma, shape (n, 2)."""
        return whitened(self.stretches, self.model, self.gains, self.sigma)

    def less(self, *names: str) -> 'Fit':
        """Return the structure without some effects, where it stood: it is not fitted again."""
        kinds = tuple(kind for kind in self.space.kinds if kind.name not in names)
        left = [place for name in names for place in self.space.places(name)]
        space = Space(self.space.declared, kinds)
        return replace(self, space=space, u=np.delete(self.u, left))

    def over(self, sigma: Array) -> Array:
        """Return the same innovations over another scale."""
        return np.asarray(self.whitened * (self.sigma / sigma))

    def whiten(self, errors: Sequence[Array]) -> Array:
        """Return what counts of errors on each stretch, (k, 2, q), over sigma, (n, 2, q)."""
        pairs = zip(errors, self.stretches, strict=True)
        rows = [of_stretch[stretch.used] for of_stretch, stretch in pairs]
        return np.asarray(np.concatenate(rows) / self.sigma[:, None])

    @property
    def point(self) -> Array:
        """Where it ended: u and then the gains, shape (p,)."""
        return np.concatenate([self.u, self.gains])

    @property
    def departure(self) -> Array:
        """How far u is from the prior: of effects, from neutral."""
        return np.asarray(self.u - self.space.prior())

    @property
    def prior_information(self) -> Array:
        """What the weak prior knows of u and then of the gains: the inverse variances."""
        return np.asarray(joint_prior(self.space).deviation ** -2.0)

    def deviance(self, sigma: Array) -> float:
        """Return twice the robust cost at a given scale."""
        return float(huber(self.over(sigma)).sum())

    @cached_property
    def jacobian(self) -> Array:
        """Derivative of whitened by u and then the gains, shape (n, 2, p)."""
        size, space = len(self.u), self.space

        def errors(point: Array) -> Array:
            return whitened(self.stretches, space.model(point[:size]), point[size:], self.sigma)

        return derivatives(errors, self.point, errors(self.point), joint_bounds(space))

    @property
    def slopes(self) -> Array:
        """The same with a row for v and one for ω of every sample, shape (2 n, p)."""
        return self.jacobian.reshape(-1, self.jacobian.shape[-1])

    def price(self, numbers: int) -> float:
        """Return by how much so many more numbers have to lower the deviance: their BIC."""
        return numbers * float(np.log(self.whitened.size))


def whitened(stretches: Sequence[Stretch], model: Model, gains: Array, sigma: Array) -> Array:
    """Return what innovations are over sigma, shape (n, 2)."""
    return np.asarray(innovations(stretches, model, gains) / sigma)


def innovations(stretches: Sequence[Stretch], model: Model, gains: Array) -> Array:
    """Return the innovations that count, of several stretches, one after the other: (n, 2)."""
    errors = np.concatenate(
        [predict(model, s, gains).innovation.take(s.counted, axis=0) for s in stretches]
    )
    if np.abs(errors).max() <= WORST:
        return errors
    # Parameters far from any robot make numbers that cannot be squared, or none: these only have
    # to be bad.
    return np.asarray(np.fmax(np.fmin(errors, WORST), -WORST))


def predictions(fit: Fit, stretches: Sequence[Stretch]) -> list[Prediction]:
    """Return the one-step predictions of a fit on any stretches."""
    return [predict(fit.model, stretch, fit.gains) for stretch in stretches]


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

    def errors(at: Array) -> Array:
        return innovations(stretches, space.model(at), gains)

    prior = Prior(space.prior(), space.deviations())
    point, sigma = minimise(errors, start, prior, space.bounds(), evaluations, rounds)
    return Fit(space, stretches, point, gains, sigma)


def joint_prior(space: Space) -> Prior:
    """Return the weak prior of u and then of the gains."""
    return Prior(
        np.concatenate([space.prior(), GAIN_PRIOR]),
        np.concatenate([space.deviations(), np.full(len(GAIN_PRIOR), PRIOR_DEVIATION)]),
    )


def joint_bounds(space: Space) -> tuple[Array, Array]:
    """Return lowest and highest values of u and then of the gains."""
    (low, high), (least, most) = space.bounds(), GAIN_LIMITS
    return np.concatenate([low, least]), np.concatenate([high, most])


def fit_prediction(
    space: Space, stretches: tuple[Stretch, ...], start: Array, gains: Array, rounds: int = ROUNDS
) -> Fit:
    """Fit parameters and noise model together by one-step prediction error.

    To the very end, unless fewer rounds are asked for.
    """
    size = len(start)

    def errors(at: Array) -> Array:
        return innovations(stretches, space.model(at[:size]), at[size:])

    begin = np.concatenate([start, gains])
    prior, bounds = joint_prior(space), joint_bounds(space)
    point, sigma = minimise(errors, begin, prior, bounds, EVALUATIONS, rounds)
    return Fit(space, stretches, point[:size], point[size:], sigma)
