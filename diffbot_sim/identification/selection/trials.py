"""Trials: every effect on top of a structure, and whether the evidence lets it in."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import nan

import numpy as np
from scipy import stats

from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.selection.candidates import approach, complete
from diffbot_sim.identification.selection.evidence import Evidence, compare
from diffbot_sim.identification.selection.screening import PROMISING, Score, Screen
from diffbot_sim.identification.statistics.guards import ELSEWHERE_LEVEL, lasting, may_be_chance
from diffbot_sim.physics.effects import Effect

# What explains less than this share of the best after a few steps is fitted to its end only where
# nothing better enters.
WORTH_COMPLETING = 0.4

SUPPORTED = 'supported'
CHANCE = 'no better than chance'
PASSING = 'not beyond a disturbance that changes slowly'
UNCONFIRMED = 'does not predict held-out data better'
BEHIND = 'explains far less than another effect'
OUTDONE = 'resembles what acts, but a free-form force explains more'
INCREDIBLE = 'fits only with values that no robot has'
UNSEEN = 'not excited by this drive'

Progress = Callable[[str], None]


@dataclass(frozen=True)
class Trial:
    """One effect tried on top of a structure."""

    kind: type[Effect]
    fit: Fit | None
    evidence: Evidence
    outcome: str

    @property
    def accepted(self) -> bool:
        """Whether the evidence was beyond doubt."""
        return self.outcome == SUPPORTED

    @property
    def refused(self) -> bool:
        """Whether it was fitted to its end, and the evidence was not beyond doubt."""
        return self.fit is not None and self.outcome not in (SUPPORTED, OUTDONE)


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
    leaders, others = _race(screen, promising, progress)

    def judged(approaches: Sequence[_Approach]) -> list[Trial]:
        return [_completed(screen.fit, a, held_out, len(kinds)) for a in approaches]

    first = judged(leaders)
    if any(trial.accepted for trial in first):
        return [*trials, *first, *(_behind(screen, a.kind, a.fall) for a in others)]
    return [*trials, *first, *judged(others)]


def _race(
    screen: Screen, promising: dict[type[Effect], Score], progress: Progress
) -> tuple[list[_Approach], list[_Approach]]:
    """Approach what is promising; return those near the best, and the others."""
    if not promising:
        return [], []
    base, found = screen.fit, list[_Approach]()
    for kind, score in promising.items():
        progress(f'fitting {kind.name}')
        near = approach(screen, kind, score)
        fall = base.deviance(base.sigma) - near.deviance(base.sigma)
        found.append(_Approach(kind, score, near, fall))
    bar = WORTH_COMPLETING * max(a.fall for a in found)
    return [a for a in found if a.fall >= bar], [a for a in found if a.fall < bar]


def _completed(
    current: Fit, approached: _Approach, held_out: Sequence[Stretch], tried: int
) -> Trial:
    fit = complete(approached.near)
    evidence = compare(current, fit, held_out).of_best(approached.score.shapes)
    outcome = judge(evidence, tried)
    if outcome == SUPPORTED and approached.kind.name in fit.incredible:
        outcome = INCREDIBLE
    return Trial(approached.kind, fit, evidence, outcome)


def _dismissed(screen: Screen, kind: type[Effect], score: Score) -> Trial:
    outcome = CHANCE if score.seen else UNSEEN
    return Trial(kind, None, _first_order(screen, kind, score.ratio, score.p_value), outcome)


def _behind(screen: Screen, kind: type[Effect], fall: float) -> Trial:
    p_value = float(stats.chi2.sf(max(fall, 0.0), len(kind.specs())))
    return Trial(kind, None, _first_order(screen, kind, fall, p_value), BEHIND)


def _first_order(screen: Screen, kind: type[Effect], fall: float, p_value: float) -> Evidence:
    """Return the evidence of what was not fitted to the end."""
    cost = len(kind.specs()) * float(np.log(screen.fit.whitened.size))
    return Evidence(fall - cost, p_value, nan, nan, nan, nan)


def judge(evidence: Evidence, tried: int) -> str:
    """Say whether an effect, one of so many tried, may enter, or why not."""
    if may_be_chance(evidence.p_value, evidence.delta_bic, tried):
        return CHANCE
    if evidence.is_refuted:
        return UNCONFIRMED
    if lasting(evidence.p_block, evidence.p_elsewhere):
        return SUPPORTED
    return PASSING if evidence.p_elsewhere <= ELSEWHERE_LEVEL else UNCONFIRMED
