"""Structure that no effect accounts for: a force that depends on something, whatever its law."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy import stats

from diffbot_sim.identification.bases import Basis, bases
from diffbot_sim.identification.evidence import block_gain, sandwich, wald_p
from diffbot_sim.identification.fitting import GAIN_LIMITS, Fit, each, huber, whitened
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
# How many of the dependences are put to the test, and the shares of them that are tried.
FOLLOWED, SHARES = 4, (1.0, 0.5, 0.25, 0.1)
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
    'wheel_force': "each wheel's commanded force",
    'force_over_time': 'time, in proportion to the commanded force',
    'place_x': 'where along x it rolls, against the motion',
    'place_y': 'where along y it rolls, against the motion',
}


@dataclass(frozen=True)
class Dependence:
    """How much a free-form force along one axis, depending on one variable, explains.

    fall: of the deviance, to first order until it is realised; amounts: coefficients of the basis
    in its units; adaptation: how the free parameters shift with them; spread: covariance of the
    amounts; p_block: as for effects.
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
        return float(stats.chi2.sf(self.fall, len(self.amounts)))


def dependences(screen: Screen) -> list[Dependence]:
    """Try every basis on the residual of a fit, the strongest first."""
    fit = screen.fit
    tried = [_try(screen, basis) for basis in bases(fit, fit.stretches)]
    return sorted(tried, key=lambda d: d.fall - len(d.amounts) * np.log(fit.whitened.size))[::-1]


def find_structure(screen: Screen, held_out: Sequence[Stretch]) -> Structure | None:
    """Return the strongest dependence that is beyond doubt, or None."""
    found = dependences(screen)
    for first_order in found[:FOLLOWED]:
        dependence = realised(screen.fit, first_order)
        beyond_chance = dependence.p_value * len(found) < LIKELIHOOD_LEVEL
        if not beyond_chance or dependence.p_block > BLOCK_LEVEL:
            continue
        if _held_out_chance(screen.fit, dependence, held_out) < HELD_OUT_LEVEL:
            return describe(dependence, screen.fit)
    return None


def outdone(rest: Fit, final: Fit, kind: type[Effect]) -> Dependence | None:
    """Return a free-form force of which an effect captures a part only, if there is one.

    rest: the fit that lacks the effect, final: the one that has it. An effect of the right kind
    needs fewer parameters than any free form, and leaves nothing of it. One that only resembles
    what acts is outdone, takes its worth from the free form, and leaves the rest of it. Structure
    that is there with and without the effect says nothing against its name. All to first order,
    so that both sides of the comparison err alike.
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
        wald_p(amounts, spread),
    )


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
    basis = next(iter(bases(fit, begun, dependence.basis)))
    pushes = [basis.total(share * dependence.amounts, index) for index in range(len(begun))]
    return whitened(begun, model, gains, fit.sigma, pushes)


def _held_out_chance(fit: Fit, dependence: Dependence, held_out: Sequence[Stretch]) -> float:
    """Return the chance of the fall of the held-out loss."""
    begun = restarted(fit.model, held_out, MAX_STEP)
    before = huber(whitened(begun, fit.model, fit.gains, fit.sigma))
    gain = before - huber(_acting(fit, dependence, held_out))
    # Where a wheel starts or stops a small force decides much: no sample may say more than this.
    return block_gain(np.clip(gain, -MOST_OF_SAMPLE, MOST_OF_SAMPLE).sum(axis=1))[1]


def describe(dependence: Dependence, fit: Fit) -> Structure:
    """Put a dependence that a fit lacks into words and a curve."""
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
        worth=dependence.fall - basis.size * float(np.log(fit.whitened.size)),
    )
