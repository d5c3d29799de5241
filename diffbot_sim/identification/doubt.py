"""Doubt: names that do not stand up to what is left when they have had their say."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import product
from typing import NamedTuple

from diffbot_sim.identification.fitting.fit import Fit, fit_prediction
from diffbot_sim.identification.free_forms.bases import again
from diffbot_sim.identification.free_forms.bursts import bursts, is_small_part_of_bursts
from diffbot_sim.identification.free_forms.dependence import Dependence, realised, worth_of
from diffbot_sim.identification.free_forms.drifting import is_of_drift
from diffbot_sim.identification.free_forms.limit import TABLES, of_another_law
from diffbot_sim.identification.free_forms.moments import pushed, standing_out
from diffbot_sim.identification.free_forms.near_rest import eased
from diffbot_sim.identification.free_forms.oscillating import oscillating
from diffbot_sim.identification.free_forms.otherwise import moves_otherwise
from diffbot_sim.identification.free_forms.structure import dependences, describe, find_dependences
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.result import LIMIT, Structure
from diffbot_sim.identification.selection.evidence import delta_bic
from diffbot_sim.identification.selection.screening import Screen
from diffbot_sim.identification.selection.stepwise import Selection
from diffbot_sim.identification.selection.trials import OUTDONE
from diffbot_sim.identification.statistics.guards import BLOCK_LEVEL, VERY_STRONG
from diffbot_sim.identification.suspicion import (
    WORTHIER,
    doubted_beside,
    in_words,
    suspected,
    weakest,
)
from diffbot_sim.physics.effects import Effect
from diffbot_sim.records import Array

# An effect that takes this share of its worth from a free form stands or falls with it.
TAKEN_SHARE = 0.5
# Shares of what an effect explains. A law of the right form leaves less than the first to a free
# form that is about the same: from which it takes more than the second, and which explains more
# by itself.
LEFT_SHARE, SAME_SHARE = 0.1, 0.15
# No effect lowered the BIC by more on any of 200 clean robots: a name that keeps more beside what
# is left is no chance.
BEYOND_CHANCE = 25.0
# A pull that is fixed in the world is a slope as far as it stays, and none if it changes more.
CHANGING = {'slope': 'pull'}
# Friction near rest is allowed for in about its form: of what that explains, as much again as this
# share may be left.
ALLOWED_SHARE = 0.5


class Seen(NamedTuple):
    """A selection, and held-out data, as they are looked at.

    near_rest: by how much a friction near rest that is allowed for lowers the deviance; strict:
    the same without that, None where nothing is allowed for.
    """

    selection: Selection
    held_out: Sequence[Stretch]
    near_rest: float = 0.0
    strict: 'Seen | None' = None

    @property
    def allowed(self) -> float:
        """By how much in BIC anything may seem to explain what is left of that friction."""
        return ALLOWED_SHARE * self.near_rest


class Doubted(NamedTuple):
    """What stands up to doubt, what is left unnamed, and what was allowed for, as in Seen."""

    selection: Selection
    unexplained: Structure | None
    near_rest: float = 0.0


Look = Callable[[Selection, Sequence[Stretch]], Seen]
# The name that is to go, empty where none is, and the structure that it goes for or that is left.
Objection = tuple[str, Structure | None]


def with_friction_eased(selection: Selection, held_out: Sequence[Stretch]) -> Seen:
    """Look at a selection of which all fits allow for the same friction near rest."""
    final, held = eased(selection.final, held_out)
    if final is selection.final:
        return Seen(selection, held)

    def refitted(fit: Fit) -> Fit:
        return fit_prediction(fit.space, final.stretches, fit.u, fit.gains)

    without = {name: refitted(fit) for name, fit in selection.without.items()}
    # The nominal fit is asked beside several names only.
    base = refitted(selection.base) if len(without) > 1 else selection.base
    seen = replace(selection, base=base, final=final, without=without)
    gained = selection.final.deviance(final.sigma) - final.deviance(final.sigma)
    return Seen(seen, held, gained, Seen(selection, held_out))


def doubt(seen: Seen, look: Look = Seen) -> Doubted:
    """Withdraw names that do not stand up to a free-form force; return what is left unnamed.

    So goes a name that nothing needs as it is looked at, one that a free form outdoes, the weakest
    where one free form outdoes all together, a limit of another law, and a name whose law leaves
    much of what it is about, or explains little beside that.
    look: how what is left is looked at, as it is unless given.
    """
    name, left = (
        _needless_name(seen) or _outdone_name(seen) or _other_limit(seen) or _left_over(seen)
    )
    selection, held_out, *_ = seen.strict or seen
    if not name:
        return Doubted(selection, left, seen.near_rest)
    doubted = doubt(look(selection.withdrawn(name, held_out, OUTDONE), held_out), look)
    # There is structure, if only what the name went for.
    told = left if left and _says_more(left, name) else doubted.unexplained or left
    return doubted._replace(unexplained=told)


def _says_more(left: Structure, name: str) -> bool:
    """Say whether a structure tells more than what is left without the name that went for it.

    That would be a part of a limit, or of a pull that changes.
    """
    return left.variable in (LIMIT, CHANGING.get(name))


def _needless_name(seen: Seen) -> Objection | None:
    """Return a name that explains nothing beside what is allowed for: it stood for that."""
    final = seen.selection.final
    for name, rest in seen.selection.without.items():
        if delta_bic(rest, final) <= 0.0:
            return name, None
    return None


def _outdone_name(seen: Seen) -> Objection | None:
    """Return a name, of one effect or the weakest of several, that a free form outdoes."""
    selection, final = seen.selection, seen.selection.final
    for kind in final.space.kinds:
        better = _outdone(selection.without[kind.name], final, (kind,))
        if better is not None:
            return kind.name, describe(better, final)
    if len(final.space.kinds) > 1:
        better = _outdone(selection.base, final, final.space.kinds)
        if better is not None:
            return weakest(selection)[1], describe(better, final)
    return None


def _other_limit(seen: Seen) -> Objection | None:
    """Return a limit that changes with speed in another way than its name says."""
    selection = seen.selection
    for kind in selection.final.space.kinds:
        if kind in TABLES:
            left = of_another_law(kind, selection.without[kind.name], selection.final)
            if left is not None:
                return kind.name, left
    return None


def _left_over(seen: Seen) -> Objection:
    """Return what is left beside all names, and the name that does not stand up to it."""
    selection, final = seen.selection, seen.selection.final
    # What is allowed for excuses no name that is worth less than what is left.
    allowed = min(seen.allowed, weakest(selection)[0])
    there = find_dependences(Screen(final), seen.held_out, allowed)
    found = [left for left in there if not is_of_drift(left, final)]
    if not found:
        return _unfound(seen)
    for kind, left in product(final.space.kinds, found):
        rest = selection.without[kind.name]
        whole = _free_form_of(rest, final, left)
        if whole is not None:
            return kind.name, describe(whole, rest)
        changing = left.basis.variable == CHANGING.get(kind.name)
        if changing and WORTHIER * selection.support[kind.name].delta_bic < worth_of(left, final):
            return kind.name, describe(left, final)
    refused = suspected(selection, seen.allowed) if selection.support else None
    name = doubted_beside(refused.worth, selection) if refused else ''
    return name, _told(found[0], final)


def _told(left: Dependence, final: Fit) -> Structure:
    """Describe what is left by a free form, or by the bursts of which that is a small part."""
    told = describe(left, final)
    if is_small_part_of_bursts(told, final):
        return bursts(final) or told
    return told


def _unfound(seen: Seen) -> Objection:
    """Doubt silence, and the weakest name, where no free form is left."""
    selection, final = seen.selection, seen.selection.final
    refused = suspected(selection, seen.allowed)
    if refused is not None:
        nearest = describe(dependences(Screen(final))[0], final)
        left = replace(nearest, description=f'{in_words(refused)}, or {nearest.description}')
        return doubted_beside(refused.worth, selection), left
    if not final.space.kinds:
        return '', pushed(final) or _nameless(seen)
    # Beside a name that is worth more, what stands out may be its own misses.
    some = standing_out(final)
    name = doubted_beside(some.worth, selection) if some else ''
    return name, some if name else _nameless(seen)


def _nameless(seen: Seen) -> Structure | None:
    """Return what depends on nothing, and is too much for noise all the same."""
    otherwise = moves_otherwise(seen.selection.final, seen.held_out)
    # What is left of friction near rest that is allowed for comes in bursts, too.
    if otherwise or (seen.strict and bursts(seen.strict.selection.final) is None):
        return otherwise
    return bursts(seen.selection.final) or oscillating(seen.selection.final)


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
    named -= sum(map(screen.price, kinds))
    best = dependences(screen)[0]
    if worth_of(best, rest) < named + VERY_STRONG or best.p_block > BLOCK_LEVEL:
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
    something else, or explains less by itself, says nothing against it, as long as the effect
    explains enough beside it: the declared friction may be of another form than the robot's, and a
    limit have a soft corner.
    """
    worth = rest.deviance(final.sigma) - final.deviance(final.sigma)
    if left.fall < LEFT_SHARE * worth:
        return None
    whole = _acting_in(rest, left, final.sigma)
    taken = whole.fall - left.fall
    price = final.price(len(final.u) - len(rest.u))
    unnamed = worth_of(left, final)
    # Beside a larger unknown what either explains only with the other's help is not the name's.
    shared = abs(taken) if unnamed > worth else max(taken, 0.0)
    much = worth - shared - price > BEYOND_CHANCE
    worthier = WORTHIER * (worth - price) > unnamed
    same = taken >= SAME_SHARE * worth and whole.fall > worth
    return None if not same and (much or worthier) else whole
