"""Cheap screening: how much of the residual each effect could explain, to first order."""

from dataclasses import dataclass

import numpy as np
from scipy import stats

from diffbot_sim.identification.coordinates import Space, guesses
from diffbot_sim.identification.fitting import Fit, whitened
from diffbot_sim.physics.effects import Effect
from diffbot_sim.records import Array

# A small amount of an effect, in coordinates of order one.
AMOUNT = 0.05
# Only what could not plausibly be chance is worth a full fit.
PROMISING = 0.02


@dataclass(frozen=True)
class Score:
    """First-order worth of an effect.

    ratio: estimate of the likelihood ratio; p_value: its chance under no effect; start: the
    point (u of the larger space) at which a full fit should begin; seen: whether the drive
    shows the effect at all once the free parameters have adapted.
    """

    ratio: float
    p_value: float
    start: Array
    seen: bool


class Screen:
    """Residual of one fit with everything that its free parameters could explain taken out."""

    def __init__(self, fit: Fit) -> None:
        self.fit = fit
        jacobian = fit.jacobian.reshape(-1, fit.jacobian.shape[-1])
        size = np.linalg.norm(jacobian, axis=0)
        free = jacobian[:, size > 1e-9] / size[size > 1e-9]
        self._basis = np.linalg.svd(free, full_matrices=False)[0]
        self._jacobian = jacobian
        self._errors = self.project(np.clip(fit.whitened, -3.0, 3.0))

    @property
    def residual(self) -> Array:
        """The errors that free parameters cannot explain, shape (2 n,)."""
        return self._errors.ravel()

    def adaptation(self, sensitivity: Array, amount: Array) -> Array:
        """Return how the free parameters shift when an amount of something is added."""
        change = sensitivity.reshape(-1, sensitivity.shape[-1]) @ amount
        shift, *_ = np.linalg.lstsq(self._jacobian, -change, rcond=1e-8)
        return np.asarray(shift)

    def project(self, values: Array) -> Array:
        """Take out of values, shape (n, 2) or (n, 2, q), what the free parameters explain."""
        flat = values.reshape(self._basis.shape[0], -1)
        rest = flat - self._basis @ (self._basis.T @ flat)
        return np.asarray(rest.reshape(values.shape))

    def explained(self, sensitivity: Array) -> tuple[float, Array, Array]:
        """Return the fall of the squared error, the coefficients, the projected sensitivity."""
        flat = self.project(sensitivity).reshape(-1, sensitivity.shape[-1])
        errors = self.residual
        amount, *_ = np.linalg.lstsq(flat, -errors, rcond=1e-8)
        fall = float(errors @ errors - np.sum((errors + flat @ amount) ** 2))
        return fall, np.asarray(amount), flat

    def score(self, kind: type[Effect]) -> Score:
        """Try small amounts of an effect, and its guesses as they stand."""
        fit = self.fit
        space = Space(fit.space.declared, (*fit.space.kinds, kind))
        neutral = np.concatenate(
            [fit.u, [c.prior for c in space.of_effects[-len(kind.specs()) :]]]
        )
        slopes = np.stack(
            [self._change(space, neutral, index) for index in range(len(fit.u), len(neutral))],
            axis=-1,
        )
        fall, amount, flat = self.explained(slopes)
        strength = float(np.linalg.norm(flat)) / (float(np.linalg.norm(slopes)) + 1e-30)
        seen = strength > 1e-3 and float(np.linalg.norm(flat)) > 1e-2
        low, high = space.bounds()
        inside = np.clip(neutral[len(fit.u) :] + amount, low[len(fit.u) :], high[len(fit.u) :])
        options = [(fall, np.concatenate([fit.u, inside]))]
        for guess in guesses(kind):
            point = np.concatenate([fit.u, guess])
            change = (self._errors_at(space, point) - fit.whitened)[..., None]
            options.append((self.explained(change)[0], point))
        ratio = max(option[0] for option in options)
        p_value = float(stats.chi2.sf(ratio, len(kind.specs())))
        return Score(ratio, p_value, self._best_start(space, options), seen)

    def _errors_at(self, space: Space, point: Array) -> Array:
        return whitened(self.fit.stretches, space.model(point), self.fit.gains, self.fit.sigma)

    def _change(self, space: Space, neutral: Array, index: int) -> Array:
        moved = neutral.copy()
        moved[index] += AMOUNT
        return np.asarray((self._errors_at(space, moved) - self.fit.whitened) / AMOUNT)

    def _best_start(self, space: Space, options: list[tuple[float, Array]]) -> Array:
        """Return the option with the lowest actual error."""
        losses = [
            float(np.clip(self._errors_at(space, point) ** 2, 0, 9).sum()) for _, point in options
        ]
        return options[int(np.argmin(losses))][1]
