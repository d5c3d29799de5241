"""Structure that no effect accounts for: a force that depends on something, whatever its law."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy import stats

from diffbot_sim.identification.bases import Basis, bases
from diffbot_sim.identification.evidence import block_gain, sandwich, wald_p
from diffbot_sim.identification.fitting import Fit, huber, whitened
from diffbot_sim.identification.predictor import MAX_STEP
from diffbot_sim.identification.result import Structure
from diffbot_sim.identification.screening import Screen
from diffbot_sim.identification.start import restarted
from diffbot_sim.identification.stretches import Stretch
from diffbot_sim.physics.effects import Effect
from diffbot_sim.records import Array

# As strict as the entry of an effect: chance over all dependences tried, disturbances, held out.
LIKELIHOOD_LEVEL, BLOCK_LEVEL, HELD_OUT_LEVEL = 1e-3, 1e-2, 0.05
# By how much in BIC a free form must beat an effect before the effect's name is withdrawn.
OUTDONE = 10.0
# An effect that takes this share of its worth from a free form stands or falls with it.
TAKEN_SHARE = 0.5
# Largest fall of the loss that one held-out sample may stand for.
MOST_OF_SAMPLE = 4.0
WORDS = {
    'v': 'the speed',
    'omega': 'the yaw rate',
    'heading': 'the heading',
    'wheel_angle': 'the wheel angle',
    'time': 'time',
    'traction': 'the commanded force',
    'command_change': 'recent changes of the command',
}


@dataclass(frozen=True)
class Dependence:
    """How much a free-form force along one axis, depending on one variable, explains.

    fall: of the deviance; amounts: coefficients of the basis in its units; spread: their
    covariance; p_value and p_block as for effects.
    """

    basis: Basis
    fall: float
    amounts: Array
    adaptation: Array
    spread: Array
    p_value: float
    p_block: float


def dependences(screen: Screen) -> list[Dependence]:
    """Try every basis on the residual of a fit, the strongest first."""
    fit = screen.fit
    tried = [_try(screen, basis) for basis in bases(fit, fit.stretches)]
    return sorted(tried, key=lambda d: d.fall - len(d.amounts) * np.log(fit.whitened.size))[::-1]


def find_structure(screen: Screen, held_out: Sequence[Stretch]) -> Structure | None:
    """Return the strongest dependence that is beyond doubt, or None."""
    found = dependences(screen)
    for dependence in found:
        beyond_chance = dependence.p_value * len(found) < LIKELIHOOD_LEVEL
        if not beyond_chance or dependence.p_block > BLOCK_LEVEL:
            continue
        if _held_out_chance(screen.fit, dependence, held_out) < HELD_OUT_LEVEL:
            return describe(dependence)
    return None


def outdone(rest: Fit, final: Fit, kind: type[Effect]) -> Dependence | None:
    """Return a free-form force of which an effect captures a part only, if there is one.

    rest: the fit that lacks the effect, final: the one that has it. An effect of the right kind
    needs fewer parameters than any free form, and leaves nothing of it. One that only resembles
    what acts is outdone, takes its worth from the free form, and leaves the rest of it. Structure
    that is there with and without the effect says nothing against its name.
    """
    screen = Screen(rest)
    size = float(np.log(rest.whitened.size))
    worth = rest.deviance(final.sigma) - final.deviance(final.sigma)
    named = max(worth, screen.score(kind).ratio) - len(kind.specs()) * size
    best = dependences(screen)[0]
    cost = len(best.amounts) * size
    if best.fall - cost < named + OUTDONE or best.p_block > BLOCK_LEVEL:
        return None
    basis = next(iter(bases(final, final.stretches, best.basis)))
    left = _try(Screen(final), basis).fall
    taken = best.fall - left
    return best if left - cost > OUTDONE and taken > TAKEN_SHARE * worth else None


def _try(screen: Screen, basis: Basis) -> Dependence:
    slopes = sensitivity(screen.fit, screen.fit.stretches, basis)
    fall, amounts, flat = screen.explained(slopes)
    rest = screen.residual + flat @ amounts
    spread = sandwich(flat, rest)
    return Dependence(
        basis,
        fall,
        amounts,
        screen.adaptation(slopes, amounts),
        spread,
        float(stats.chi2.sf(fall, len(amounts))),
        wald_p(amounts, spread),
    )


def sensitivity(fit: Fit, stretches: Sequence[Stretch], basis: Basis) -> Array:
    """Return the derivative of whitened errors by the amounts of a basis, shape (n, 2, q)."""
    base = whitened(stretches, fit.model, fit.gains, fit.sigma)
    columns = []
    for index in range(basis.size):
        pushes = [basis.push(stretch_index, index) for stretch_index in range(len(stretches))]
        moved = whitened(stretches, fit.model, fit.gains, fit.sigma, pushes)
        columns.append(moved - base)
    return np.stack(columns, axis=-1)


def _held_out_chance(fit: Fit, dependence: Dependence, held_out: Sequence[Stretch]) -> float:
    """Return the chance of the fall of squared held-out errors, to first order."""
    begun = restarted(fit.model, held_out, MAX_STEP)
    twin = next(iter(bases(fit, begun, dependence.basis)))
    errors = whitened(begun, fit.model, fit.gains, fit.sigma)
    change = sensitivity(fit, begun, twin) @ dependence.amounts
    change = change + fit.jacobian_on(begun) @ dependence.adaptation
    # Where a wheel starts or stops a first-order change means nothing: no sample may say much.
    gain = np.clip(huber(errors) - huber(errors + change), -MOST_OF_SAMPLE, MOST_OF_SAMPLE)
    return block_gain(gain.sum(axis=1))[1]


def describe(dependence: Dependence) -> Structure:
    """Put a dependence into words and a curve."""
    basis = dependence.basis
    knots, curve, error = basis.curve(dependence.amounts, dependence.spread)
    strength = basis.strength(dependence.amounts)
    kind, unit = ('force along the robot', 'N') if basis.axis == 'v' else ('torque', 'N·m')
    return Structure(
        description=(
            f'a {kind} of {strength:.3g} {unit} rms that depends on '
            f'{WORDS[basis.variable]} and that no effect of the library accounts for'
        ),
        axis=basis.axis,
        variable=basis.variable,
        strength=strength,
        p_value=dependence.p_block,
        knots=knots,
        force=curve,
        force_error=error,
    )
