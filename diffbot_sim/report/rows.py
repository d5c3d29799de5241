"""Rows of the tables, in words, that the page and the terminal share."""

from dataclasses import dataclass, replace

from diffbot_sim.identification.result import (
    LAW,
    Candidate,
    Estimate,
    FoundEffect,
    Identification,
    RunCheck,
)
from diffbot_sim.parameters import Spec, specs
from diffbot_sim.physics.effects import library
from diffbot_sim.physics.friction import ACTIVE, Friction
from diffbot_sim.physics.model import Model
from diffbot_sim.physics.robot import Robot
from diffbot_sim.report.errors import ratio
from diffbot_sim.report.numerals import estimate_text, significant, unit_text
from diffbot_sim.report.sentences import alternatives, p_text, why

EVIDENCE = {
    'delta_bic': 'the BIC falls by',
    'p_value': 'likelihood-ratio p',
    'p_block': 'p robust against serial correlation',
    'held_out_gain': 'held-out log likelihood per sample rises by',
}


@dataclass(frozen=True)
class ParameterRow:
    """A parameter, its value now and, where there were any, before and beside effects."""

    name: str
    meaning: str
    value: str
    declared: str = ''
    beside: str = ''


@dataclass(frozen=True)
class EffectRow:
    """An effect that was found, in words."""

    name: str
    meaning: str
    parameters: list[ParameterRow]
    evidence: list[tuple[str, str]]
    alternatives: str


@dataclass(frozen=True)
class CandidateRow:
    """How an effect fared, in words."""

    name: str
    meaning: str
    score: str
    p_value: str
    p_block: str
    held_out_gain: str
    outcome: str


@dataclass(frozen=True)
class RunRow:
    """How one run agrees with the others: errors and, in brackets, their ratio to the noise."""

    name: str
    agrees: bool
    set_aside: bool
    v: str
    omega: str
    why: str


def run_row(run: RunCheck) -> RunRow:
    """Put the agreement of one run into words; v in mm/s, ω in mrad/s."""
    v, omega = (
        f'{significant(1e3 * error)} ({significant(ratio(error, floor), 2)})'
        for error, floor in (
            (run.error.v_rmse, run.noise_floor.v_rmse),
            (run.error.omega_rmse, run.noise_floor.omega_rmse),
        )
    )
    return RunRow(run.name, run.agrees, run.set_aside, v, omega, why(run))


def effect_row(effect: FoundEffect) -> EffectRow:
    """Put a found effect into words."""
    known = {spec.name: spec for spec in _effect_specs(effect.name)}
    parameters = [
        ParameterRow(name, known[name].meaning if name in known else '', estimate_text(estimate))
        for name, estimate in effect.parameters.items()
    ]
    evidence = [_evidence(name, value) for name, value in effect.evidence.items()]
    return EffectRow(effect.name, meaning(effect.name), parameters, evidence, alternatives(effect))


def nominal_rows(result: Identification) -> list[ParameterRow]:
    """List the parameters of the declared model, before and after, and beside effects found."""
    plain = [_nominal(result.declared, *item) for item in result.nominal.items()]
    found = result.nominal_beside
    return [
        replace(row, beside=estimate_text(found[row.name])) if row.name in found else row
        for row in plain
    ]


def kept_rows(result: Identification) -> list[ParameterRow]:
    """List the parameters of robot and friction that stayed as declared, and are used."""
    robot, friction = result.declared.robot, result.declared.friction
    unused = set(ACTIVE['generalized']).difference(friction.active)
    law = {'model'} if LAW in result.contradicted else set[str]()
    return [
        ParameterRow(spec.name, spec.meaning, _as_declared(part, spec))
        for part in (robot, friction)
        for spec in specs(part)
        if spec.name not in {*result.nominal, *unused, *law}
    ]


def candidate_row(candidate: Candidate) -> CandidateRow:
    """Put one trial into words."""
    return CandidateRow(
        candidate.name,
        meaning(candidate.name),
        significant(candidate.score),
        p_text(candidate.p_value),
        p_text(candidate.p_block),
        significant(candidate.held_out_gain, 2),
        candidate.outcome,
    )


def meaning(name: str) -> str:
    """Return an effect's one line of meaning; empty for a name outside the library."""
    kind = library().get(name)
    return '' if kind is None else kind.meaning


def _effect_specs(name: str) -> tuple[Spec, ...]:
    kind = library().get(name)
    return () if kind is None else kind.specs()


def _nominal(model: Model, name: str, estimate: Estimate) -> ParameterRow:
    part = model.robot if hasattr(model.robot, name) else model.friction
    (spec,) = (spec for spec in specs(part) if spec.name == name)
    return ParameterRow(name, spec.meaning, estimate_text(estimate), _as_declared(part, spec))


def _as_declared(part: Robot | Friction, spec: Spec) -> str:
    value = getattr(part, spec.name)
    return value if spec.choices else f'{value:g}{unit_text(spec.unit)}'


def _evidence(name: str, value: float) -> tuple[str, str]:
    said = p_text(value) if name.startswith('p_') else significant(value)
    return EVIDENCE.get(name, name.replace('_', ' ')), said
