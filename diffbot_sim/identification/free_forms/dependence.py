"""How much a free-form force that depends on one variable explains of what a fit leaves."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from math import nan

import numpy as np
from scipy import stats

from diffbot_sim.identification.fitting.fit import (
    Fit,
    fit_prediction,
    joint_bounds,
    joint_prior,
    whitened,
)
from diffbot_sim.identification.free_forms.bases import UNIT_SHARE, Basis
from diffbot_sim.identification.free_forms.variables import VARIABLES
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.selection.screening import Screen
from diffbot_sim.identification.statistics.blocks import sandwich, wald_p
from diffbot_sim.identification.statistics.gains import THRICE_CHANCE, folds_chance
from diffbot_sim.identification.statistics.memory import fall_of_deviance
from diffbot_sim.identification.statistics.minimisation import Prior, derivatives, minimise
from diffbot_sim.identification.statistics.projection import apart
from diffbot_sim.identification.statistics.robust import huber
from diffbot_sim.records import Array

# Evaluations of a fit of a free form, and shares of what first order promises at which it begins.
EVALUATIONS, SHARES = 10, (0.0, 0.25, 0.5, 1.0)
# The most that an amount may be, and what it may well be, in largest commands: where parameters
# of the model can do the same, they do.
MOST, TYPICAL = 1.0, 0.1


@dataclass(frozen=True)
class Dependence:
    """How much a free-form force along one axis, depending on one variable, explains.

    fall: of the deviance, to first order until it is realised; beyond: the same, or what is beyond
    the errors' own past, if less; amounts: coefficients of the basis in its units; adaptation: by
    how much u and gains shift with them, once realised; spread: covariance of the amounts, once
    realised with the parameters as they are; p_block: as for effects, like p_value for the best of
    all that the form was looked at with.
    """

    basis: Basis
    fall: float
    beyond: float
    amounts: Array
    adaptation: Array
    spread: Array
    p_block: float
    p_folds: float = nan

    def adapted(self, fit: Fit) -> Array:
        """Return where u and gains of a fit shift to, once realised."""
        return fit.point + self.adaptation

    @property
    def p_value(self) -> float:
        """The chance of such a fall."""
        return _of_best(self.basis, float(stats.chi2.sf(self.beyond, len(self.amounts))))


def _of_best(basis: Basis, chance: float) -> float:
    """Return the chance of the best of all that a form was looked at with: rates, say."""
    return min(1.0, VARIABLES[basis.variable].form.looked_at * chance)


def explained_by(screen: Screen, basis: Basis) -> Dependence:
    """Return how much the functions of a basis explain of a residual, to first order."""
    slopes = sensitivity(screen, basis)
    fall, amounts, flat = screen.explained(slopes)
    rest = screen.residual + flat @ amounts
    columns, errors = (basis.parted(rows, screen.fit.stretches) for rows in (flat, rest))
    spread = sandwich(columns, errors, np.ones(flat.shape[1]))
    return Dependence(
        basis,
        fall,
        fall,
        amounts,
        np.zeros(len(screen.fit.u) + len(screen.fit.gains)),
        spread,
        _of_best(basis, wald_p(amounts, spread)),
    )


def realised(fit: Fit, like: Dependence) -> Dependence:
    """Return a free form fitted together with the free parameters and the noise model.

    First order promises too much where these would have to move far, as friction parameters do
    beside a free form of the friction, and where a wheel stands or starts otherwise than before.
    like: the same to first order, or in another fit; the fit begins at the share of it that errs
    least.
    """
    basis = like.basis
    known, (low, high) = joint_prior(fit.space), joint_bounds(fit.space)
    none, units = np.zeros(basis.size), np.full(basis.size, 1.0 / UNIT_SHARE)

    def errors(at: Array) -> Array:
        return acting(fit, basis, at, fit.stretches)

    prior = Prior(
        np.concatenate([known.centre, none]), np.concatenate([known.deviation, TYPICAL * units])
    )
    bounds = np.concatenate([low, -MOST * units]), np.concatenate([high, MOST * units])
    size = len(known.centre)
    starts = [np.append(fit.point, share * like.amounts) for share in SHARES]
    start = min(starts, key=lambda at: float(huber(errors(at)).sum()))
    point, _ = minimise(errors, start, prior, bounds, EVALUATIONS, rounds=1)
    left = errors(point)
    jacobian = derivatives(errors, point, left, bounds).reshape(-1, len(point))
    slopes, rest = (basis.parted(rows, fit.stretches) for rows in (jacobian, left.ravel()))
    information = prior.deviation**-2.0
    joint = sandwich(slopes, rest, information)[size:, size:]
    # Around the model without it a robot that waits at another place seems to deny what made it.
    without = apart(rest, slopes[:, :size], slopes[:, size:], point[size:])
    return Dependence(
        basis,
        fall=max(float(huber(fit.whitened).sum() - huber(left).sum()), 0.0),
        beyond=fall_of_deviance(fit.whitened, left),
        amounts=point[size:],
        adaptation=(point - start)[:size],
        spread=sandwich(slopes[:, size:], rest, information[size:]),
        p_block=_of_best(basis, wald_p(point[size:], joint)),
        p_folds=folds_chance(*without, THRICE_CHANCE),
    )


def against_the_model(fit: Fit, dependence: Dependence) -> Dependence:
    """Return a realised dependence, held against the model alone, fitted from where it led.

    Errors jump where a wheel just breaks away, and fits end in any of many hollows: a better one
    is no merit of the form that found it.
    """
    u, gains = np.split(dependence.adapted(fit), [len(fit.u)])
    alone = fit_prediction(fit.space, fit.stretches, u, gains)
    gained = fit.deviance(fit.sigma) - alone.deviance(fit.sigma)
    if gained <= 0.0:
        return dependence
    fall = max(dependence.fall - gained, 0.0)
    beyond = fall_of_deviance(alone.over(fit.sigma), beside(fit, dependence))
    return replace(dependence, fall=fall, beyond=beyond)


def best_against_the_model(fit: Fit, tried: Iterable[Dependence]) -> Dependence:
    """Return the worthiest of realised dependences, held against the model alone.

    That takes worth away and adds none: what has less than the best before it is not fitted.
    """
    first, *others = by_worth(tried, fit)
    best = against_the_model(fit, first)
    for dependence in others:
        if worth_of(dependence, fit) <= worth_of(best, fit):
            break
        best = max(best, against_the_model(fit, dependence), key=lambda d: worth_of(d, fit))
    return best


def acting(fit: Fit, basis: Basis, at: Array, stretches: Sequence[Stretch]) -> Array:
    """Return whitened errors on stretches at a point: u, gains, amounts of the basis."""
    u, gains, amounts = np.split(at, [len(fit.u), len(fit.u) + len(fit.gains)])
    return whitened(basis.pushed(stretches, amounts), fit.space.model(u), gains, fit.sigma)


def beside(fit: Fit, dependence: Dependence) -> Array:
    """Return whitened errors where a realised dependence acts besides, shape (n, 2)."""
    at = np.append(dependence.adapted(fit), dependence.amounts)
    return acting(fit, dependence.basis, at, fit.stretches)


def sensitivity(screen: Screen, basis: Basis) -> Array:
    """Return the derivative of whitened errors by the amounts of a basis, shape (n, 2, q)."""
    errors = []
    for index, response in enumerate(screen.responses):
        pushes = [basis.push(index, function) for function in range(basis.size)]
        errors.append(response.errors(np.stack(pushes, axis=-1)))
    return screen.fit.whiten(errors)


def by_worth(dependences: Iterable[Dependence], fit: Fit) -> list[Dependence]:
    """Return dependences, the worthiest first."""
    return sorted(dependences, key=lambda dependence: -worth_of(dependence, fit))


def worth_of(dependence: Dependence, fit: Fit) -> float:
    """Return by how much a dependence lowers the BIC."""
    return dependence.fall - fit.price(dependence.basis.size)
