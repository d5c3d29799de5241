"""Which effects enter: forward while the evidence is beyond doubt, then backward."""

from collections.abc import Container, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from operator import itemgetter
from typing import NamedTuple

from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.fitting.shaking import shaken
from diffbot_sim.identification.recordings.recordings import Recordings
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.selection.candidates import (
    approach,
    begun_anew,
    complete,
    fit_without,
    on_recordings,
    refitted,
)
from diffbot_sim.identification.selection.evidence import Evidence, compare
from diffbot_sim.identification.selection.hidden import hidden
from diffbot_sim.identification.selection.rivals import comes_up
from diffbot_sim.identification.selection.screening import Screen
from diffbot_sim.identification.selection.trials import (
    CROWDED,
    NEEDLESS,
    SUPPORTED,
    Progress,
    Trial,
    judge_again,
    try_all,
)
from diffbot_sim.identification.statistics.parallel import side_by_side
from diffbot_sim.physics.effects import Effect

# What explains less than this share of what a found effect does, to first order, is no rival.
RIVAL_SHARE = 0.25
MOST_EFFECTS = 4


@dataclass(frozen=True)
class Selection:
    """Where the search ended.

    base: the nominal fit; final: the chosen one; trials: the last trial of each effect, best
    first; without: for each effect chosen, the fit that lacks it; support: the evidence for it
    within the final structure; alternatives: those that the data cannot tell from it.
    """

    base: Fit
    final: Fit
    trials: tuple[Trial, ...]
    without: dict[str, Fit]
    support: dict[str, Evidence]
    alternatives: dict[str, tuple[str, ...]]

    @property
    def excitation(self) -> dict[str, str]:
        """The drive that shows each effect tried best."""
        return {trial.kind.name: trial.kind.excitation for trial in self.trials}

    def withdrawn(self, name: str, held_out: Sequence[Stretch], why: str) -> 'Selection':
        """Return the selection without one of the effects chosen, the others weighed anew.

        Those that were worth something beside it only, as where both hid each other, go with it.
        """
        kept = [key for key in self.support if key != name]
        trials = tuple(
            replace(trial, outcome=why) if trial.kind.name == name else trial
            for trial in self.trials
        )
        alternatives = {key: self.alternatives[key] for key in kept}
        less = replace(self, trials=trials, alternatives=alternatives)
        left = less._weighed(self.without[name], kept, held_out)
        needless = {
            key: it.delta_bic
            for key, it in left.support.items()
            if judge_again(it, len(trials)) == NEEDLESS
        }
        if not needless:
            return left
        return left.withdrawn(min(needless, key=lambda key: needless[key]), held_out, NEEDLESS)

    def fitted_anew(
        self, base: Fit, recordings: Recordings, held_out: Sequence[Stretch]
    ) -> 'Selection':
        """Return the same structure, fitted to recordings that are taken otherwise.

        base: the nominal fit to these.
        """
        final = refitted(on_recordings(self.final, recordings))
        return replace(self, base=base)._weighed(final, list(self.support), held_out)

    def stands(self, tried: int) -> bool:
        """Say whether each effect, of so many that were tried, is beyond doubt."""
        return all(judge_again(it, tried) == SUPPORTED for it in self.support.values())

    def _weighed(
        self, final: Fit, names: Sequence[str], held_out: Sequence[Stretch]
    ) -> 'Selection':
        """Return the selection with another fit of these effects, each weighed anew."""
        fits, looks = side_by_side(partial(fit_without, final), names), _looks(self.trials)
        without = dict(zip(names, fits, strict=True))
        support = _support(final, without, looks, held_out)
        return replace(self, final=final, without=without, support=support)


class Tried(NamedTuple):
    """A structure, and the trials of every effect on top of it."""

    screen: Screen
    trials: Sequence[Trial]

    @property
    def best(self) -> Fit | None:
        """The fit of the effect that enters, None where none does."""
        accepted = [(t.evidence.delta_bic, t.fit) for t in self.trials if t.accepted and t.fit]
        _, best = max(accepted, key=itemgetter(0), default=(0.0, None))
        return best

    def fit_of(self, kind: type[Effect]) -> Fit | None:
        """Return the fit of an effect to its end, None where it was not fitted so far."""
        return next((trial.fit for trial in self.trials if trial.kind is kind), None)


def tried_on(
    fit: Fit, kinds: Sequence[type[Effect]], held_out: Sequence[Stretch], progress: Progress
) -> Tried:
    """Try effects on top of a structure."""
    screen = Screen(fit)
    return Tried(screen, try_all(screen, kinds, held_out, progress))


def forward(
    path: Sequence[Tried],
    kinds: Sequence[type[Effect]],
    held_out: Sequence[Stretch],
    progress: Progress,
) -> Sequence[Tried]:
    """Let effects enter on top of the last structure of a path, one by one, until none does."""
    while len(grown := one_more(path, kinds, held_out, progress)) > len(path):
        path = grown
    return path


def one_more(
    path: Sequence[Tried],
    kinds: Sequence[type[Effect]],
    held_out: Sequence[Stretch],
    progress: Progress,
) -> Sequence[Tried]:
    """Return a path with the structure that has one effect more, if an effect enters."""
    ahead = _ahead(path, kinds, held_out, progress)
    return path if ahead is None else (*path, ahead)


def _ahead(
    path: Sequence[Tried],
    kinds: Sequence[type[Effect]],
    held_out: Sequence[Stretch],
    progress: Progress,
) -> Tried | None:
    """Return the structure with one effect more, None where nothing enters.

    Where none does by itself, one goes ahead that may be hidden, if another enters beside it. The
    backward search keeps neither unless each is needed beside the other.
    """
    last, more = path[-1], kinds if len(path) < MOST_EFFECTS else ()
    if last.best is not None:
        progress(f'{last.best.space.kinds[-1].name} enters')
        return tried_on(shaken(begun_anew(last.best)), more, held_out, progress)
    for near in hidden(last.screen, more):
        progress(f'trying others beside {near.space.kinds[-1].name}')
        alone = last.fit_of(near.space.kinds[-1]) or complete(near)
        beside = tried_on(shaken(begun_anew(alone)), more, held_out, progress)
        if beside.best is not None:
            return beside
    return None


def select(
    path: Sequence[Tried],
    kinds: Sequence[type[Effect]],
    held_out: Sequence[Stretch],
    progress: Progress,
) -> Selection:
    """Let those effects leave again which the forward search no longer needs at its end.

    path: the structures of that, the nominal one first.
    """
    fits = [tried.screen.fit for tried in path]
    last = {trial.kind.name: trial for tried in path for trial in tried.trials}
    looks = _looks(last.values())
    final, without, support, left = _prune(fits, len(kinds), looks, held_out, progress)
    told = [_with_outcome(trial, without, left) for trial in last.values()]
    trials = sorted(told, key=lambda t: (t.kind.name in without, t.evidence.delta_bic))
    alternatives = {
        name: _alternatives(final, name, _screened(rest, path), kinds, progress)
        for name, rest in without.items()
    }
    return Selection(fits[0], final, tuple(reversed(trials)), without, support, alternatives)


def _looks(trials: Iterable[Trial]) -> dict[str, int]:
    """Return how many shapes of each effect were tried."""
    return {trial.kind.name: trial.looks for trial in trials}


def _with_outcome(trial: Trial, chosen: Container[str], left: Mapping[str, str]) -> Trial:
    """Return a trial with what came of it in the end; left: why effects left again."""
    if trial.kind.name in chosen:
        return replace(trial, outcome=SUPPORTED)
    if not trial.accepted:
        return trial
    return replace(trial, outcome=left.get(trial.kind.name, CROWDED))


class _Pruned(NamedTuple):
    """What the backward search kept, as in Selection, and why each effect left that did."""

    final: Fit
    without: dict[str, Fit]
    support: dict[str, Evidence]
    left: dict[str, str]


def _prune(
    path: Sequence[Fit],
    tried: int,
    looks: Mapping[str, int],
    held_out: Sequence[Stretch],
    progress: Progress,
) -> _Pruned:
    """Take out, one by one, effects that later ones have made needless, or unsure.

    path: the fits of the forward search; looks: how many shapes of each effect were tried. Each
    is asked once more from where the larger one led: an effect must not live off a poor end of
    the fit that lacks it, nor may what lacks it explain the data as well.
    """
    fit, left = path[-1], dict[str, str]()
    while True:
        names = [kind.name for kind in fit.space.kinds]
        if names:
            progress(f'trying without {", ".join(names)}')
        smaller = dict(zip(names, side_by_side(partial(_less_one, fit, path), names), strict=True))
        support = _support(fit, smaller, looks, held_out)
        outcomes = {name: judge_again(support[name], tried) for name in support}
        outcomes |= dict.fromkeys(fit.incredible & outcomes.keys(), NEEDLESS)
        leaving = [name for name, outcome in outcomes.items() if outcome != SUPPORTED]
        if not leaving:
            return _Pruned(fit, smaller, support, left)
        worst = min(leaving, key=lambda name: support[name].delta_bic)
        progress(f'{worst} leaves')
        fit, left[worst] = smaller[worst], outcomes[worst]


def _support(
    fit: Fit, without: Mapping[str, Fit], looks: Mapping[str, int], held_out: Sequence[Stretch]
) -> dict[str, Evidence]:
    """Weigh a fit against those that lack one of its effects each; looks: as in _prune."""
    return {
        name: compare(rest, fit, held_out).of_best(looks[name]) for name, rest in without.items()
    }


def _less_one(fit: Fit, path: Sequence[Fit], name: str) -> Fit:
    """Return the best fit of the structure that lacks one of the effects; path: as in _prune."""
    rest = {kind for kind in fit.space.kinds if kind.name != name}
    ends = [fit_without(fit, name), *(f for f in path if set(f.space.kinds) == rest)]
    return min(ends, key=lambda end: end.deviance(fit.sigma))


def _screened(fit: Fit, path: Sequence[Tried]) -> Screen:
    """Return the screen of a fit; those of the path know its scores already."""
    return next((tried.screen for tried in path if tried.screen.fit is fit), None) or Screen(fit)


def _alternatives(
    final: Fit, name: str, screen: Screen, kinds: Sequence[type[Effect]], progress: Progress
) -> tuple[str, ...]:
    """Return effects that, added to the rest, explain the data as well as what was found."""
    present = {effect.name for effect in final.model.effects}
    (chosen,) = (kind for kind in final.space.kinds if kind.name == name)
    # First order promises too little on a rough floor, but to both alike.
    worth = screen.fit.deviance(final.sigma) - final.deviance(final.sigma)
    worth = min(worth, screen.score(chosen).ratio)
    found = []
    for kind in kinds:
        if kind.name in present:
            continue
        score = screen.score(kind)
        if not score.seen or score.ratio < RIVAL_SHARE * worth:
            continue
        progress(f'trying {kind.name} as an alternative')
        if comes_up(approach(screen, kind), final):
            found.append(kind.name)
    return tuple(found)
