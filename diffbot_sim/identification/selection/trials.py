"""Trials: every effect on top of a structure, and whether the evidence lets it in."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import nan

from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.fitting.negligible import simulates_alike, uncorrected
from diffbot_sim.identification.fitting.shaking import shaken
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.selection.candidates import approach, complete, fit_without
from diffbot_sim.identification.selection.evidence import (
    Evidence,
    compare,
    delta_bic,
    rise_without,
    wald,
)
from diffbot_sim.identification.selection.feedback import is_of_feedback
from diffbot_sim.identification.selection.rivals import comes_up
from diffbot_sim.identification.selection.screening import PROMISING, Score, Screen
from diffbot_sim.identification.statistics.guards import (
    BLOCK_LEVEL,
    ELSEWHERE_LEVEL,
    VERY_STRONG,
    chance_of_fall,
    lasting,
    may_be_chance,
)
from diffbot_sim.identification.statistics.parallel import side_by_side
from diffbot_sim.physics.effects import Effect

# What promises less than this share of the best to first order is approached, and what explains
# less than that one after a few steps is fitted to its end, only where nothing better enters.
WORTH_APPROACHING, WORTH_COMPLETING = 0.1, 0.4
# What explains less than this share of its price after a few steps never comes to be worth it, as
# long as it promised less than that price to first order: where a noise model follows what is
# missing, a few steps lead nowhere at first.
HOPEFUL = 0.2
# What makes an effect what it is explains, by its curvature, at least this share of what that
# effect does. Of limits of voltage it was more than all; where others were taken for one, 0.02.
ESSENTIAL_SHARE = 0.1

SUPPORTED = 'supported'
CHANCE = 'no better than chance'
PASSING = 'not beyond a disturbance that changes slowly'
UNCONFIRMED = 'does not predict held-out data better'
BEHIND = 'explains far less than another effect'
OUTDONE = 'resembles what acts, but a free-form force explains more'
INCREDIBLE = 'fits only with values that no robot has'
BEREFT = 'nothing of it but what it shares with another effect'
WORSENING = 'simulates held-out data worse, beside what is unexplained'
SLIGHT = 'changes the motion by less than simulators of one robot differ by'
HEARD = 'only while the forces hardly change, as where a controller hears more than was recorded'
UNSEEN = 'not excited by this drive'
NEEDLESS = 'explained almost as well without it'
CROWDED = 'no place left beside the effects found before'
# Where these are said nothing speaks against the effect, or something else was told in its place.
UNOPPOSED = (SUPPORTED, OUTDONE, WORSENING, SLIGHT, HEARD, NEEDLESS, CROWDED)

Progress = Callable[[str], None]


@dataclass(frozen=True)
class Trial:
    """One effect tried on top of a structure; fit: to the end, None where it was not fitted.

    looks: how many shapes were tried, of which this is the best; what is asked of it counts them.
    """

    kind: type[Effect]
    fit: Fit | None
    evidence: Evidence
    outcome: str
    looks: int = 1

    @property
    def accepted(self) -> bool:
        """Whether the evidence was beyond doubt."""
        return self.outcome == SUPPORTED

    @cached_property
    def worth(self) -> float:
        """By how much it lowers the BIC, held against its fit without the effect, too.

        That may be better than the one that it was tried on: fits end in any of many hollows.
        """
        if self.fit is None:
            return self.evidence.delta_bic
        alone = shaken(fit_without(self.fit, self.kind.name))
        return min(self.evidence.delta_bic, delta_bic(alone, self.fit))

    @property
    def refused(self) -> bool:
        """Whether it was fitted to its end, and the evidence was not beyond doubt."""
        return self.fit is not None and self.outcome not in UNOPPOSED


@dataclass(frozen=True)
class _Approach:
    """An effect that was fitted for a short while, and by how much the deviance fell."""

    kind: type[Effect]
    score: Score
    near: Fit
    fall: float


def try_all(
    screen: Screen, kinds: Sequence[type[Effect]], held_out: Sequence[Stretch], progress: Progress
) -> list[Trial]:
    """Screen every effect that is not there yet; fit and weigh what is promising."""
    present = {effect.name for effect in screen.fit.model.effects}
    scores = {}
    for kind in kinds:
        if kind.name not in present:
            progress(f'trying {kind.name}')
            scores[kind] = screen.score(kind)
    promising = {k: s for k, s in scores.items() if s.seen and s.p_value <= PROMISING}
    trials = [_dismissed(screen, k, s) for k, s in scores.items() if k not in promising]
    return [*trials, *_judged(screen, promising, held_out, len(kinds), progress)]


def _judged(
    screen: Screen,
    promising: Mapping[type[Effect], Score],
    held_out: Sequence[Stretch],
    tried: int,
    progress: Progress,
) -> list[Trial]:
    """Fit and weigh what is promising; what falls far behind only where nothing better enters."""
    best = max((score.ratio for score in promising.values()), default=0.0)
    far = {k: s for k, s in promising.items() if s.ratio < WORTH_APPROACHING * best}
    near = _approached(screen, {k: s for k, s in promising.items() if k not in far}, progress)
    bar = WORTH_COMPLETING * max((a.fall for a in near), default=0.0)
    leaders = [a for a in near if a.fall >= bar]
    others = [a for a in near if a.fall < bar]
    first = _fitted_in_turn(screen, leaders, held_out, tried)
    if any(trial.accepted for trial in first):
        behind = [(a.kind, a.fall) for a in others] + [(k, s.ratio) for k, s in far.items()]
        return [*first, *(_not_fitted(screen, *told, BEHIND) for told in behind)]
    others += _approached(screen, far, progress)
    return [*first, *(_completed(screen, a, held_out, tried) for a in others)]


def _fitted_in_turn(
    screen: Screen, leaders: Sequence[_Approach], held_out: Sequence[Stretch], tried: int
) -> list[Trial]:
    """Fit leaders to the end, the best first; others while they may come up to one accepted."""
    trials = list[Trial]()
    for leader in sorted(leaders, key=lambda a: -a.fall):
        accepted = [trial for trial in trials if trial.accepted]
        best = max(accepted, key=lambda trial: trial.evidence.delta_bic, default=None)
        if best is None or best.fit is None or comes_up(leader.near, best.fit):
            trials.append(_completed(screen, leader, held_out, tried))
        else:
            trials.append(_not_fitted(screen, leader.kind, leader.fall, BEHIND))
    return trials


def _approached(
    screen: Screen, promising: Mapping[type[Effect], Score], progress: Progress
) -> list[_Approach]:
    if promising:
        progress(f'fitting {", ".join(kind.name for kind in promising)}')
    base = screen.fit

    def approached(kind: type[Effect]) -> _Approach:
        near = approach(screen, kind)
        fall = base.deviance(base.sigma) - near.deviance(base.sigma)
        return _Approach(kind, promising[kind], near, fall)

    return side_by_side(approached, promising)


def _completed(
    screen: Screen, approached: _Approach, held_out: Sequence[Stretch], tried: int
) -> Trial:
    kind, fall, price = approached.kind, approached.fall, screen.price(approached.kind)
    if fall < HOPEFUL * price and approached.score.ratio < price:
        return _not_fitted(screen, kind, fall, CHANCE)
    fit = complete(approached.near)
    looks = approached.score.shapes
    evidence = compare(screen.fit, fit, held_out).of_best(looks)
    outcome = judge(evidence, tried)
    if outcome == SUPPORTED and kind.name in fit.incredible:
        outcome = INCREDIBLE
    elif outcome == SUPPORTED and _is_bereft(fit, kind, evidence.delta_bic + price):
        outcome = BEREFT
    elif outcome == SUPPORTED and is_of_feedback(fit, kind.name):
        outcome = HEARD
    elif outcome == SUPPORTED and simulates_alike(fit, uncorrected(screen.fit, fit.sigma)):
        outcome = SLIGHT
    return Trial(kind, fit, evidence, outcome, looks)


def _is_bereft(fit: Fit, kind: type[Effect], explained: float) -> bool:
    """Say whether what makes an effect what it is may be neutral, or explains next to nothing.

    explained: by how much the deviance falls by the whole effect.
    """
    places = zip(kind.specs(), fit.space.places(kind.name), strict=True)
    essential = [place for spec, place in places if spec.name in kind.essential]
    if not essential:
        return False
    little = rise_without(fit, essential) < ESSENTIAL_SHARE * explained
    return little or wald(fit, essential, fit.space.shapes) > BLOCK_LEVEL


def _dismissed(screen: Screen, kind: type[Effect], score: Score) -> Trial:
    outcome = CHANCE if score.seen else UNSEEN
    return Trial(kind, None, _first_order(screen, kind, score.ratio, score.p_value), outcome)


def _not_fitted(screen: Screen, kind: type[Effect], fall: float, outcome: str) -> Trial:
    p_value = chance_of_fall(fall, len(kind.specs()))
    return Trial(kind, None, _first_order(screen, kind, fall, p_value), outcome)


def _first_order(screen: Screen, kind: type[Effect], fall: float, p_value: float) -> Evidence:
    """Return the evidence of what was not fitted to the end."""
    return Evidence(fall - screen.price(kind), p_value, nan, nan, nan, nan)


def judge(evidence: Evidence, tried: int) -> str:
    """Say whether an effect, one of so many tried, may enter, or why not."""
    if may_be_chance(evidence.p_value, evidence.delta_bic, tried):
        return CHANCE
    if evidence.is_refuted:
        return UNCONFIRMED
    if lasting(evidence.p_block, evidence.p_elsewhere):
        return SUPPORTED
    return PASSING if evidence.p_elsewhere <= ELSEWHERE_LEVEL else UNCONFIRMED


def judge_again(evidence: Evidence, tried: int) -> str:
    """Say the same of an effect among all that entered: what lacks it must not explain as much."""
    if may_be_chance(evidence.p_value, evidence.delta_bic - VERY_STRONG, tried):
        return NEEDLESS
    return judge(evidence, tried)
