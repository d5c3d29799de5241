"""Structure that no effect accounts for: a force that depends on something, whatever its law."""

from collections.abc import Sequence
from functools import partial
from math import inf, isinf

import numpy as np

from diffbot_sim.identification.fitting.fit import Fit, whitened
from diffbot_sim.identification.fitting.negligible import simulates_alike
from diffbot_sim.identification.fitting.predictor import NO_GAIN
from diffbot_sim.identification.free_forms.bases import again, bases
from diffbot_sim.identification.free_forms.dependence import (
    Dependence,
    acting,
    against_the_model,
    by_worth,
    explained_by,
    realised,
    worth_of,
)
from diffbot_sim.identification.free_forms.floor import by_place
from diffbot_sim.identification.free_forms.returning import is_denied_on_return
from diffbot_sim.identification.free_forms.spotting import Spot
from diffbot_sim.identification.free_forms.variables import VARIABLES
from diffbot_sim.identification.recordings.start import restarted
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.result import Structure
from diffbot_sim.identification.selection.screening import Screen
from diffbot_sim.identification.statistics.gains import chance_of
from diffbot_sim.identification.statistics.guards import (
    BLOCK_LEVEL,
    EITHER_LEVEL,
    VERY_STRONG,
    is_chance,
    lasting,
    least_worth,
    may_be_chance,
)
from diffbot_sim.identification.statistics.parallel import side_by_side
from diffbot_sim.identification.statistics.robust import huber

# How many of the dependences are put to the test.
FOLLOWED = 6
# A dependence explains almost as much as another with this share of its worth.
ALMOST = 0.9
FORCES = {
    'v': ('force along the robot', 'N'),
    'omega': ('torque', 'N·m'),
    'wheels': ('force on each wheel', 'N'),
    'difference': ('force on one wheel and against it on the other', 'N'),
}


def dependences(screen: Screen) -> list[Dependence]:
    """Try every basis on the residual of a fit, the strongest first."""
    fit = screen.fit
    return by_worth((explained_by(screen, basis) for basis in bases(fit, fit.stretches)), fit)


def find_dependences(
    screen: Screen, held_out: Sequence[Stretch], least: float = 0.0
) -> list[Dependence]:
    """Return dependences that are beyond doubt and explain almost as much as the strongest.

    The one of fewest functions, which says most, comes first. least: the worth that is asked for.
    """
    fit, tried = screen.fit, dependences(screen)
    # First order promises too little on a rough floor: how many were tried counts after the fit.
    promising = [d for d in tried if not is_chance(d.p_value, 1)]
    fitted = side_by_side(partial(realised, fit), _best_of_each(promising)[:FOLLOWED])
    found = list[Dependence]()
    for dependence in by_worth(fitted, fit):
        # What is fair takes worth away: what is behind before that is behind for ever.
        if worth_of(dependence, fit) <= least:
            break
        fair = _beyond_doubt(fit, dependence, held_out, len(tried))
        if fair is not None:
            found.append(fair)
            least = max(least, ALMOST * worth_of(fair, fit))
    near = [d for d in found if worth_of(d, fit) > least]
    return sorted(by_worth(near, fit), key=lambda d: d.basis.size)


def _best_of_each(dependences: Sequence[Dependence]) -> list[Dependence]:
    """Return the first dependence on each variable along each axis: of a line and a curve, say."""
    first = dict[tuple[str, str], Dependence]()
    for dependence in dependences:
        first.setdefault((dependence.basis.variable, dependence.basis.axis), dependence)
    return list(first.values())


def _beyond_doubt(
    fit: Fit, dependence: Dependence, held_out: Sequence[Stretch], tried: int
) -> Dependence | None:
    """Return a dependence that is beyond doubt, as it is against the model alone; None if not."""
    if _may_be_chance(dependence, fit, tried) or dependence.p_block > EITHER_LEVEL:
        return None
    if _is_slight(fit, dependence):
        return None
    if _is_of_spot(dependence) and is_denied_on_return(fit, dependence):
        return None
    least = _least_worth(fit, dependence, held_out)
    if isinf(least):
        return None
    fair = against_the_model(fit, dependence)
    return None if _may_be_chance(fair, fit, tried) or worth_of(fair, fit) <= least else fair


def _least_worth(fit: Fit, dependence: Dependence, held_out: Sequence[Stretch]) -> float:
    """Return by what it must lower the BIC to be believed, infinite if other data deny it."""
    p_block, p_folds = dependence.p_block, dependence.p_folds
    if _is_of_place(dependence):
        # A rough floor is the same again where the robot comes back, so that held-out data
        # confirm nothing: other parts of the floor must, and be as sure as blocks.
        sure = p_folds <= BLOCK_LEVEL and lasting(p_block, p_folds)
        return 0.0 if sure else inf
    return least_worth(p_block, p_folds, _held_out_chance(fit, dependence, held_out))


def _is_of_place(dependence: Dependence) -> bool:
    return VARIABLES[dependence.basis.variable].order is by_place


def _is_of_spot(dependence: Dependence) -> bool:
    return isinstance(VARIABLES[dependence.basis.variable].form, Spot)


def _is_slight(fit: Fit, dependence: Dependence) -> bool:
    """Say whether it changes the motion by next to nothing; a spot does so nearly everywhere."""
    if _is_of_place(dependence):
        return False
    adapted = fit.u + dependence.adaptation[: len(fit.u)]
    at = np.concatenate([adapted, NO_GAIN, dependence.amounts])
    return simulates_alike(fit, acting(fit, dependence.basis, at, fit.stretches))


def _may_be_chance(dependence: Dependence, fit: Fit, tried: int) -> bool:
    # Like a name, it must lower the BIC by what tells structures apart.
    worth = worth_of(dependence, fit) - VERY_STRONG
    return may_be_chance(dependence.p_value, worth, tried)


def _held_out_chance(fit: Fit, dependence: Dependence, held_out: Sequence[Stretch]) -> float:
    """Return the chance of the fall of the held-out loss."""
    begun = restarted(fit.model, held_out)
    before = huber(whitened(begun, fit.model, fit.gains, fit.sigma))
    adapted = dependence.adapted(fit)
    at = np.append(adapted, dependence.amounts)
    begun = restarted(fit.space.model(adapted[: len(fit.u)]), held_out)
    basis = again(dependence.basis, fit, begun)
    return chance_of(before - huber(acting(fit, basis, at, begun)))


def describe(dependence: Dependence, fit: Fit) -> Structure:
    """Put a dependence that a fit lacks into words and a curve, that of its strongest part."""
    basis = dependence.basis
    strength, strengths = basis.strength(dependence.amounts), basis.strengths(dependence.amounts)
    part = max(strengths, key=strengths.__getitem__)
    knots, curve, error = basis.curve(dependence.amounts, dependence.spread, part)
    kind, unit = FORCES[basis.axis]
    each = ', '.join(f'{size:.3g} {unit} {name}' for name, size in strengths.items() if name)
    return Structure(
        description=(
            f'a {kind} of {strength:.3g} {unit} rms{each and f" ({each})"} that depends on '
            f'{basis.words} and that no effect of the library accounts for'
        ),
        axis=basis.axis,
        variable=basis.variable,
        over=VARIABLES[basis.variable].over,
        strength=strength,
        p_value=dependence.p_block,
        knots=knots,
        force=curve,
        force_error=error,
        worth=worth_of(dependence, fit),
        part=part,
        spot=basis.grid if _is_of_spot(dependence) else None,
    )
