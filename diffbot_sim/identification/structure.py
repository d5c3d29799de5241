"""Structure that no effect accounts for: a force that depends on something, whatever its law."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy import stats

from diffbot_sim.identification.bases import Basis, again, bases
from diffbot_sim.identification.evidence import block_gain, sandwich, wald_p
from diffbot_sim.identification.fitting import GAIN_LIMITS, Fit, whitened
from diffbot_sim.identification.parallel import each
from diffbot_sim.identification.predictor import MAX_STEP
from diffbot_sim.identification.result import Structure
from diffbot_sim.identification.robust import huber
from diffbot_sim.identification.screening import Screen
from diffbot_sim.identification.start import restarted
from diffbot_sim.identification.stretches import Stretch
from diffbot_sim.identification.variables import VARIABLES
from diffbot_sim.records import Array

# As strict as the entry of an effect: chance over all dependences tried, disturbances, held out.
LIKELIHOOD_LEVEL, BLOCK_LEVEL, HELD_OUT_LEVEL = 1e-3, 1e-2, 0.05
# Of the last two neither may be above this, and together they may not be above what they are at
# their levels: where one is beyond all doubt, the other need not be so strict.
EITHER_LEVEL = 0.05
BOTH_LEVEL = float(stats.combine_pvalues([BLOCK_LEVEL, HELD_OUT_LEVEL]).pvalue)
# How many of the dependences are put to the test, and the shares of them that are tried.
FOLLOWED, SHARES = 4, (1.0, 0.5, 0.25, 0.1)
# Parts of the runs, and into how many groups of parts they are dealt in turn.
PARTS, FOLDS = 40, 5
# Keeps functions apart that the other parts of a run hardly show.
RIDGE = 1e-6
# Largest fall of the loss that one held-out sample may stand for.
MOST_OF_SAMPLE = 4.0
FORCES = {
    'v': ('force along the robot', 'N'),
    'omega': ('torque', 'N·m'),
    'wheels': ('force on each wheel', 'N'),
    'difference': ('force on one wheel and against it on the other', 'N'),
}


@dataclass(frozen=True)
class Dependence:
    """How much a free-form force along one axis, depending on one variable, explains.

    fall: of the deviance, to first order until it is realised; amounts: coefficients of the basis
    in its units; adaptation: how the free parameters shift with them; spread: covariance of the
    amounts; p_block: as for effects; p_folds: the chance of what amounts from other parts of the
    runs predict of each part.
    """

    basis: Basis
    fall: float
    amounts: Array
    adaptation: Array
    spread: Array
    p_block: float
    p_folds: float

    @property
    def p_value(self) -> float:
        """The chance of such a fall."""
        looked_at = VARIABLES[self.basis.variable].form.looked_at
        return looked_at * float(stats.chi2.sf(self.fall, len(self.amounts)))


def dependences(screen: Screen) -> list[Dependence]:
    """Try every basis on the residual of a fit, the strongest first."""
    fit = screen.fit
    tried = [explained_by(screen, basis) for basis in bases(fit, fit.stretches)]
    return sorted(tried, key=lambda dependence: worth_of(dependence, fit))[::-1]


def find_dependence(screen: Screen, held_out: Sequence[Stretch]) -> Dependence | None:
    """Return the strongest dependence that is beyond doubt, or None."""
    found = dependences(screen)
    for first_order in found[:FOLLOWED]:
        dependence = realised(screen.fit, first_order)
        beyond_chance = dependence.p_value * len(found) < LIKELIHOOD_LEVEL
        if not beyond_chance or dependence.p_block > EITHER_LEVEL:
            continue
        held_out_chance = _held_out_chance(screen.fit, dependence, held_out)
        elsewhere = 2.0 * min(held_out_chance, dependence.p_folds)
        if lasting(dependence.p_block, elsewhere):
            return dependence
    return None


def lasting(p_block: float, elsewhere: float) -> bool:
    """Say whether something is neither a passing disturbance nor a fit to one: Fisher's method.

    elsewhere: the chance of what it predicts of data that it was not fitted to.
    """
    if max(p_block, elsewhere) > EITHER_LEVEL:
        return False
    both = np.maximum([p_block, elsewhere], np.finfo(float).tiny)
    return bool(stats.combine_pvalues(both).pvalue <= BOTH_LEVEL)


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
        screen.adaptation(slopes, amounts),
        spread,
        wald_p(amounts, spread),
        _folds_chance(flat, screen.residual),
    )


def _folds_chance(flat: Array, errors: Array) -> float:
    """Return the chance of the fall of the loss in each part of a run, by the other parts.

    Parts lie between each other: where a robot never comes back, or time has gone, the end of a
    run cannot confirm what the beginning says.
    """
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
    return _chance(gain.reshape(-1, 2))


def _chance(gain: Array) -> float:
    """Return the chance of gains of samples, shape (n, 2)."""
    # Where a wheel starts or stops a small force decides much: no sample may say more than this.
    return block_gain(np.clip(gain, -MOST_OF_SAMPLE, MOST_OF_SAMPLE).sum(axis=1))[1]


def sensitivity(fit: Fit, stretches: Sequence[Stretch], basis: Basis) -> Array:
    """Return the derivative of whitened errors by the amounts of a basis, shape (n, 2, q)."""
    base = whitened(stretches, fit.model, fit.gains, fit.sigma)

    def column(index: int) -> Array:
        pushes = [basis.push(place, index) for place in range(len(stretches))]
        return whitened(stretches, fit.model, fit.gains, fit.sigma, pushes) - base

    return np.stack(each(column, range(basis.size)), axis=-1)


def realised(fit: Fit, dependence: Dependence) -> Dependence:
    """Return the share of a dependence that lowers the deviance most when it really acts.

    First order promises too much where the free parameters would have to move far.
    """
    before = float(huber(fit.whitened).sum())
    falls = {
        share: before - float(huber(_acting(fit, dependence, fit.stretches, share)).sum())
        for share in SHARES
    }
    best = max(falls, key=lambda share: falls[share])
    return replace(
        dependence,
        fall=max(falls[best], 0.0),
        amounts=best * dependence.amounts,
        adaptation=best * dependence.adaptation,
        spread=best**2 * dependence.spread,
    )


def _acting(
    fit: Fit, dependence: Dependence, stretches: Sequence[Stretch], share: float = 1.0
) -> Array:
    """Return whitened errors when the force acts and the free parameters have adapted."""
    adapted, size = share * dependence.adaptation, len(fit.u)
    model = fit.space.model(np.clip(fit.u + adapted[:size], *fit.space.bounds()))
    gains = np.clip(fit.gains + adapted[size:], *GAIN_LIMITS)
    begun = restarted(model, stretches, MAX_STEP) if stretches is not fit.stretches else stretches
    basis = again(dependence.basis, fit, begun)
    pushes = [basis.total(share * dependence.amounts, index) for index in range(len(begun))]
    return whitened(begun, model, gains, fit.sigma, pushes)


def _held_out_chance(fit: Fit, dependence: Dependence, held_out: Sequence[Stretch]) -> float:
    """Return the chance of the fall of the held-out loss."""
    begun = restarted(fit.model, held_out, MAX_STEP)
    before = huber(whitened(begun, fit.model, fit.gains, fit.sigma))
    return _chance(before - huber(_acting(fit, dependence, held_out)))


def describe(dependence: Dependence, fit: Fit) -> Structure:
    """Put a dependence that a fit lacks into words and a curve."""
    basis = dependence.basis
    knots, curve, error = basis.curve(dependence.amounts, dependence.spread)
    strength = basis.strength(dependence.amounts)
    kind, unit = FORCES[basis.axis]
    return Structure(
        description=(
            f'a {kind} of {strength:.3g} {unit} rms that depends on '
            f'{VARIABLES[basis.variable].words} and that no effect of the library accounts for'
        ),
        axis=basis.axis,
        variable=basis.variable,
        strength=strength,
        p_value=dependence.p_block,
        knots=knots,
        force=curve,
        force_error=error,
        worth=worth_of(dependence, fit),
    )


def worth_of(dependence: Dependence, fit: Fit) -> float:
    """Return by how much a dependence lowers the BIC."""
    return dependence.fall - dependence.basis.size * float(np.log(fit.whitened.size))
