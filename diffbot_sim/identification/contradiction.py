"""What is declared and the recordings contradict: effects of another size, a friction law."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from diffbot_sim.identification.doubt import BEYOND_CHANCE
from diffbot_sim.identification.fitting.coordinates import Space, point_of
from diffbot_sim.identification.fitting.fit import Fit, fit_prediction
from diffbot_sim.identification.found import Found
from diffbot_sim.identification.selection.evidence import delta_bic
from diffbot_sim.identification.statistics.guards import VERY_STRONG
from diffbot_sim.physics.effects import Effect
from diffbot_sim.physics.model import Model
from diffbot_sim.records import Array

GENERAL = 'generalized'
# Within this share of itself an effect is of about the declared size.
SAME = 0.5


def contradicted(found: Found) -> tuple[Effect, ...]:
    """Return the declared effects that recordings would rather have otherwise, or not at all.

    Asked only where something is named or left unexplained, with what was named and without: a
    name may stand for what a declared effect does wrong.
    """
    if not found.says_something:
        return ()
    final = found.undoubted.final
    fits = (found.undoubted.base, *((final,) if final.space.kinds else ()))
    return tuple(
        effect
        for effect in final.space.declared.effects
        if effect.is_sought and any(_is_contradicted(effect, fit) for fit in fits)
    )


def law_is_contradicted(found: Found) -> bool:
    """Say whether recordings would rather have the generalized law of friction than a simple one.

    Asked, too, where friction near rest of another form was allowed for.
    """
    if not (found.says_something or found.near_rest > 0.0):
        return False
    fit = found.undoubted.final
    general = replace(fit.space, declared=with_general_law(fit.space.declared))
    if general.declared == fit.space.declared:
        return False
    effects = fit.u[len(fit.space.nominal) :]
    start = np.concatenate([general.prior()[: len(general.nominal)], effects])
    freed = fit_prediction(general, fit.stretches, start, fit.gains)
    return delta_bic(fit, freed) > BEYOND_CHANCE


def with_general_law(model: Model) -> Model:
    """Return a model with the generalized law of friction."""
    law = model.friction
    static = max(law.mu_static, law.mu_coulomb)
    return replace(model, friction=replace(law, model=GENERAL, mu_static=static))


def resized(declared: Model, effects: Sequence[Effect], found: Found) -> Model:
    """Return a declared model without contradicted effects, but for those of about their size.

    These have the parameters that they were found with: they are recalibrated as friction is.
    """
    there = {effect.name: effect for effect in found.selection.final.model.effects}
    for effect in effects:
        declared = declared.without(effect.name)
        other = there.get(effect.name)
        if other is not None and _is_about(effect, other):
            declared = declared.with_effect(other)
    return declared


def _is_about(effect: Effect, other: Effect) -> bool:
    """Say whether an effect's parameters differ by less than half of what they do from neutral."""
    kind = type(effect)
    first, second, neutral = (point_of(kind, it.values) for it in (effect, other, kind()))
    return bool(np.linalg.norm(second - first) < SAME * np.linalg.norm(second - neutral))


def explains_better(other: Found, found: Found) -> bool:
    """Say whether a search without declared effects is to be believed, rather than the first."""
    if bool(other.unexplained) != bool(found.unexplained):
        return other.unexplained is None
    if _as_taken(found) != _as_taken(other):
        return len(other.names) < len(found.names)
    return delta_bic(found.undoubted.final, other.undoubted.final) > VERY_STRONG


def _as_taken(found: Found) -> tuple[object, ...]:
    """Return what recordings were taken to be: of other data no deviances can be compared."""
    count = len(found.undoubted.final.whitened)
    return count, found.behind, found.lead, found.noisy is None


def _is_contradicted(effect: Effect, fit: Fit) -> bool:
    """Say whether a fit is better beyond chance with the effect's parameters free."""
    space = replace(fit.space, kinds=(*fit.space.kinds, type(effect)))
    freed = (
        fit_prediction(space, fit.stretches, u, fit.gains) for u in _starts(effect, fit, space)
    )
    return max(delta_bic(fit, it) for it in freed) > BEYOND_CHANCE


def _starts(effect: Effect, fit: Fit, space: Space) -> Iterator[Array]:
    """Yield where to begin: with the effect as declared, and without it."""
    for values in (point_of(type(effect), effect.values), space.prior()[len(fit.u) :]):
        yield np.concatenate([fit.u, values])
