"""Doubt: names that do not stand up to what is left when they have had their say."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import product
from math import inf

import numpy as np

from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.fitting.shaking import shaken
from diffbot_sim.identification.free_forms.bases import again
from diffbot_sim.identification.free_forms.dependence import Dependence, realised, worth_of
from diffbot_sim.identification.free_forms.moments import pushed
from diffbot_sim.identification.free_forms.structure import dependences, describe, find_dependences
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.result import Structure
from diffbot_sim.identification.selection.candidates import reduce
from diffbot_sim.identification.selection.evidence import delta_bic
from diffbot_sim.identification.selection.screening import Screen
from diffbot_sim.identification.selection.stepwise import Selection
from diffbot_sim.identification.selection.trials import INCREDIBLE, Trial
from diffbot_sim.identification.statistics.guards import BLOCK_LEVEL
from diffbot_sim.physics.effects import Effect
from diffbot_sim.records import Array

# By how much in BIC a free form must beat an effect before the effect's name is withdrawn.
OUTDONE = 10.0
# An effect that takes this share of its worth from a free form stands or falls with it.
TAKEN_SHARE = 0.5
# Shares of what an effect explains. A law of the right form leaves less than the first to a free
# form that is about the same: from which it takes more than the second.
LEFT_SHARE, SAME_SHARE = 0.1, 0.15
# No effect lowered the BIC by half as much on any of 200 clean robots; what does is no chance,
# though it may not enter.
SUSPICIOUS = 50.0
# A name that is worth less is believed beside what is left, or refused, if that explains less than
# this share of it.
WORTHIER = 0.5


def doubt(selection: Selection, held_out: Sequence[Stretch]) -> tuple[Selection, Structure | None]:
    """Withdraw names that do not stand up to a free-form force; return what is left unnamed.

    So goes a name that a free form outdoes, the weakest where one free form outdoes all together,
    and a name whose law leaves much of what it is about, or explains little beside that.
    """
    final = selection.final
    for kind in final.space.kinds:
        better = _outdone(selection.without[kind.name], final, (kind,))
        if better is not None:
            return _without(selection, kind.name, describe(better, final), held_out)
    if len(final.space.kinds) > 1:
        better = _outdone(selection.base, final, final.space.kinds)
        if better is not None:
            return _without(selection, _weakest(selection)[1], describe(better, final), held_out)
    found = find_dependences(Screen(final), held_out)
    if not found:
        return _pushed(*_suspicion(selection, held_out))
    for kind, left in product(final.space.kinds, found):
        rest = selection.without[kind.name]
        whole = _free_form_of(rest, final, left)
        if whole is not None:
            return _without(selection, kind.name, describe(whole, rest), held_out)
    return selection, describe(found[0], final)


def _suspicion(
    selection: Selection, held_out: Sequence[Stretch]
) -> tuple[Selection, Structure | None]:
    """Doubt silence, and the weakest name, beside a refused effect that is beyond chance."""
    final = selection.final
    refused = [t for t in selection.trials if t.refused and not t.evidence.is_contradicted]
    most = max(refused, key=lambda t: t.evidence.delta_bic, default=None)
    suspected = 0.0 if most is None else _worth_without_luck(most)
    if most is None or suspected < SUSPICIOUS:
        return selection, None
    nearest = describe(dependences(Screen(final))[0], final)
    words = f'something that {most.kind.name} explains in part, though {_but(most)}, or'
    left = replace(nearest, description=f'{words} {nearest.description}')
    worth, weakest = _weakest(selection)
    if WORTHIER * worth > suspected:
        return selection, left
    return _without(selection, weakest, left, held_out)


def _but(refused: Trial) -> str:
    """Say why an effect that explains much may not enter."""
    incredible = refused.outcome == INCREDIBLE
    return 'only with values that no robot has' if incredible else 'not all along the runs'


def _pushed(selection: Selection, left: Structure | None) -> tuple[Selection, Structure | None]:
    """Ask moments of what nothing else is said of; beside a name they may be its own misses."""
    if left is not None or selection.final.space.kinds:
        return selection, left
    return selection, pushed(selection.final)


def _worth_without_luck(trial: Trial) -> float:
    """Return by how much an effect lowers the BIC, held against its fit without the effect, too.

    That may be better than the one that it was tried on: fits end in any of many hollows.
    """
    if trial.fit is None or trial.evidence.delta_bic < SUSPICIOUS:
        return trial.evidence.delta_bic
    alone = shaken(reduce(trial.fit, trial.kind.name))
    return min(trial.evidence.delta_bic, delta_bic(alone, trial.fit))


def _weakest(selection: Selection) -> tuple[float, str]:
    """Return the least worth of a name, and which it is; infinite where there is none."""
    worths = ((evidence.delta_bic, name) for name, evidence in selection.support.items())
    return min(worths, default=(inf, ''))


def _without(
    selection: Selection, name: str, instead: Structure, held_out: Sequence[Stretch]
) -> tuple[Selection, Structure]:
    """Doubt what is left when a name has gone; there is structure, if only what it went for."""
    selection, structure = doubt(selection.withdrawn(name), held_out)
    return selection, structure or instead


def _outdone(rest: Fit, final: Fit, kinds: Sequence[type[Effect]]) -> Dependence | None:
    """Return a free-form force of which effects capture a part only, if there is one.

    rest: the fit that lacks the effects, final: the one that has them. An effect of the right kind
    needs fewer parameters than any free form, and leaves of it what chance would. One that only
    resembles what acts is outdone, takes its worth from the free form, and leaves the rest of it.
    Structure that is there with and without the effect says nothing against its name.
    """
    screen = Screen(rest)
    worth = rest.deviance(final.sigma) - final.deviance(final.sigma)
    # To first order, as the free forms: both sides of the comparison err alike.
    named = max(worth, *(screen.score(kind).ratio for kind in kinds))
    named -= sum(len(kind.specs()) for kind in kinds) * float(np.log(rest.whitened.size))
    best = dependences(screen)[0]
    if worth_of(best, rest) < named + OUTDONE or best.p_block > BLOCK_LEVEL:
        return None
    whole, left = (_acting_in(fit, best, final.sigma) for fit in (rest, final))
    if worth_of(whole, rest) <= named:
        return None
    taken = whole.fall - left.fall
    stands = worth_of(left, final) <= 0.0 or taken <= TAKEN_SHARE * worth
    return None if stands else whole


def _acting_in(fit: Fit, like: Dependence, sigma: Array) -> Dependence:
    """Return the free form of a dependence as it really acts in a fit, at a given scale."""
    basis = again(like.basis, fit, fit.stretches)
    return realised(replace(fit, sigma=sigma), replace(like, basis=basis))


def _free_form_of(rest: Fit, final: Fit, left: Dependence) -> Dependence | None:
    """Return the free-form force that an effect of a wrong form stands for, if that is so.

    rest: the fit that lacks the effect, final: the one that has it; left: what is beyond doubt in
    it. A law of the right form leaves little to a free form that is about the same. What is about
    something else says nothing against it, as long as the effect explains enough beside it: the
    declared friction may be of another form than the robot's.
    """
    worth = rest.deviance(final.sigma) - final.deviance(final.sigma)
    if left.fall < LEFT_SHARE * worth:
        return None
    whole = _acting_in(rest, left, final.sigma)
    taken = whole.fall - left.fall
    price = (len(final.u) - len(rest.u)) * float(np.log(final.whitened.size))
    much = worth - taken - price > SUSPICIOUS
    worthier = WORTHIER * (worth - price) > worth_of(left, final)
    return None if taken < SAME_SHARE * worth and (much or worthier) else whole
