"""How much a free-form force that depends on one variable explains of what a fit leaves."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy import stats

from diffbot_sim.identification.bases import UNIT_SHARE, Basis
from diffbot_sim.identification.evidence import block_gain, sandwich, wald_p
from diffbot_sim.identification.fitting import Fit, joint_bounds, joint_prior, whitened
from diffbot_sim.identification.minimisation import Prior, derivatives, minimise
from diffbot_sim.identification.parallel import each
from diffbot_sim.identification.robust import huber
from diffbot_sim.identification.screening import Screen
from diffbot_sim.identification.stretches import Stretch
from diffbot_sim.identification.variables import VARIABLES
from diffbot_sim.records import Array

# Evaluations of a fit of a free form.
EVALUATIONS = 10
# The most that an amount may be, and what it may well be, in largest commands: where parameters
# of the model can do the same, they do.
MOST, TYPICAL = 1.0, 0.1
# Parts of the runs, and into how many groups of parts they are dealt in turn.
PARTS, FOLDS = 40, 5
# Keeps functions apart that the other parts of a run hardly show.
RIDGE = 1e-6
# Largest fall of the loss that one held-out sample may stand for.
MOST_OF_SAMPLE = 4.0


@dataclass(frozen=True)
class Dependence:
    """How much a free-form force along one axis, depending on one variable, explains.

    fall: of the deviance, to first order until it is realised; amounts: coefficients of the basis
    in its units; adaptation: by how much u and gains shift with them, once realised; spread:
    covariance of the amounts, once realised with the parameters as they are; p_block: as for
    effects.
    """

    basis: Basis
    fall: float
    amounts: Array
    adaptation: Array
    spread: Array
    p_block: float

    @property
    def p_value(self) -> float:
        """The chance of such a fall."""
        looked_at = VARIABLES[self.basis.variable].form.looked_at
        return looked_at * float(stats.chi2.sf(self.fall, len(self.amounts)))


def explained_by(screen: Screen, basis: Basis) -> Dependence:
    """Return how much the functions of a basis explain of a residual, to first order."""
    slopes = sensitivity(screen.fit, screen.fit.stretches, basis)
    fall, amounts, flat = screen.explained(slopes)
    rest = screen.residual + flat @ amounts
    spread = sandwich(flat, rest, np.ones(flat.shape[1]))
    return Dependence(
        basis,
        fall,
        amounts,
        np.zeros(len(screen.fit.u) + len(screen.fit.gains)),
        spread,
        wald_p(amounts, spread),
    )


def realised(fit: Fit, basis: Basis) -> Dependence:
    """Return a free form fitted together with the free parameters and the noise model.

    First order promises too much where these would have to move far, as friction parameters do
    beside a free form of the friction.
    """
    known, (low, high) = joint_prior(fit.space), joint_bounds(fit.space)
    none, units = np.zeros(basis.size), np.full(basis.size, 1.0 / UNIT_SHARE)

    def errors(at: Array) -> Array:
        return acting(fit, basis, at, fit.stretches)

    prior = Prior(
        np.concatenate([known.centre, none]), np.concatenate([known.deviation, TYPICAL * units])
    )
    bounds = np.concatenate([low, -MOST * units]), np.concatenate([high, MOST * units])
    start, size = np.concatenate([fit.u, fit.gains, none]), len(known.centre)
    point, _ = minimise(errors, start, prior, bounds, EVALUATIONS, rounds=1)
    left = errors(point)
    slopes = derivatives(errors, point, left).reshape(-1, len(point))
    information = prior.deviation**-2.0
    joint = sandwich(slopes, left.ravel(), information)[size:, size:]
    return Dependence(
        basis,
        fall=max(float(huber(fit.whitened).sum() - huber(left).sum()), 0.0),
        amounts=point[size:],
        adaptation=(point - start)[:size],
        spread=sandwich(slopes[:, size:], left.ravel(), information[size:]),
        p_block=wald_p(point[size:], joint),
    )


def acting(fit: Fit, basis: Basis, at: Array, stretches: Sequence[Stretch]) -> Array:
    """Return whitened errors on stretches at a point: u, gains, amounts of the basis."""
    u, gains, amounts = np.split(at, [len(fit.u), len(fit.u) + len(fit.gains)])
    pushes = [basis.total(amounts, index) for index in range(len(stretches))]
    return whitened(stretches, fit.space.model(u), gains, fit.sigma, pushes)


def sensitivity(fit: Fit, stretches: Sequence[Stretch], basis: Basis) -> Array:
    """Return the derivative of whitened errors by the amounts of a basis, shape (n, 2, q)."""
    base = whitened(stretches, fit.model, fit.gains, fit.sigma)

    def column(index: int) -> Array:
        pushes = [basis.push(place, index) for place in range(len(stretches))]
        return whitened(stretches, fit.model, fit.gains, fit.sigma, pushes) - base

    return np.stack(each(column, range(basis.size)), axis=-1)


def folds_chance(screen: Screen, basis: Basis) -> float:
    """Return the chance of what amounts from other parts of the runs predict of each part.

    To first order. Parts lie between each other: where a robot never comes back, or time has gone,
    the end of a run cannot confirm what the beginning says.
    """
    slopes = sensitivity(screen.fit, screen.fit.stretches, basis)
    flat, errors = screen.project(slopes).reshape(-1, basis.size), screen.residual
    columns = flat / np.maximum(np.linalg.norm(flat, axis=0), 1e-12)
    parts = np.arange(len(errors)) * PARTS // len(errors) % FOLDS
    inside = [(columns[parts == fold], errors[parts == fold]) for fold in range(FOLDS)]
    squares = np.array([c.T @ c for c, _ in inside])
    products = np.array([c.T @ e for c, e in inside])
    gain = np.empty(len(errors))
    for fold, (c, e) in enumerate(inside):
        others = squares.sum(axis=0) - squares[fold] + RIDGE * np.eye(columns.shape[1])
        amounts = np.linalg.solve(others, products[fold] - products.sum(axis=0))
        gain[parts == fold] = huber(e) - huber(e + c @ amounts)
    return chance_of(gain.reshape(-1, 2))


def chance_of(gain: Array) -> float:
    """Return the chance of gains of samples, shape (n, 2)."""
    # Where a wheel starts or stops a small force decides much: no sample may say more than this.
    return block_gain(np.clip(gain, -MOST_OF_SAMPLE, MOST_OF_SAMPLE).sum(axis=1))[1]


def worth_of(dependence: Dependence, fit: Fit) -> float:
    """Return by how much a dependence lowers the BIC."""
    return dependence.fall - dependence.basis.size * float(np.log(fit.whitened.size))
