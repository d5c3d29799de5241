"""report.json: the answer for programs. Keys and nesting are fixed; more may be added."""

import json
from dataclasses import asdict
from math import isfinite, nan
from typing import Any

import numpy as np

from diffbot_sim.identification.result import (
    Comparison,
    ErrorNorm,
    Estimate,
    FoundEffect,
    Identification,
    RunCheck,
)
from diffbot_sim.report.errors import MODELS, run_errors
from diffbot_sim.report.numerals import unit_text
from diffbot_sim.report.origin import Origin
from diffbot_sim.report.sentences import why


def json_text(result: Identification, origin: Origin) -> str:
    """Write the answer as JSON: full precision, SI units, null for what is not a number."""
    plain = _plain(as_dict(result) | {'origin': asdict(origin)})
    return json.dumps(plain, indent=2, ensure_ascii=False, allow_nan=False) + '\n'


def as_dict(result: Identification) -> dict[str, Any]:
    """Lay the answer out in the form of report.json."""
    return {
        'verdict': result.verdict,
        'effects': [_effect(effect) for effect in result.effects],
        'unexplained': None if result.unexplained is None else asdict(result.unexplained),
        'empirical': result.empirical
        and {'name': result.empirical.name, 'parameters': asdict(result.empirical)},
        'nominal': {
            'parameters': _estimates(result.nominal),
            'beside_effects': _estimates(result.nominal_beside),
        },
        'error': asdict(result.errors),
        'candidates': [asdict(candidate) for candidate in result.candidates],
        'advice': list(result.advice),
        'horizons': [asdict(horizon) for horizon in result.horizons],
        'runs': _runs(result),
        'timings': [asdict(timing) for timing in result.timings],
        'biases': [asdict(bias) for bias in result.biases],
        'near_rest': result.near_rest,
        'contradicted': list(result.contradicted),
        'added_noise': result.added_noise and asdict(result.added_noise),
    }


def _effect(effect: FoundEffect) -> dict[str, Any]:
    return {
        'name': effect.name,
        'parameters': _estimates(effect.parameters),
        'evidence': effect.evidence,
        'alternatives': list(effect.alternatives),
        'separate_by': effect.separate_by,
    }


def _estimates(estimates: dict[str, Estimate]) -> dict[str, Any]:
    return {name: _estimate(it) for name, it in estimates.items()}


def _estimate(it: Estimate) -> dict[str, Any]:
    unit = unit_text(it.unit).strip()
    return {
        'value': it.value,
        'ci95': [it.low, it.high],
        'unit': unit,
        'at_bound': it.at_bound,
    }


def _runs(result: Identification) -> list[dict[str, Any]]:
    """List every run: how it agrees with the others, and the models' errors where held out."""
    held_out = {run.run: run for run in result.comparisons}
    checks = {run.name: run for run in result.runs}
    names = dict.fromkeys([*checks, *held_out])
    return [
        {'name': name, **_agreement(checks.get(name)), **_held_out(held_out.get(name))}
        for name in names
    ]


def _agreement(run: RunCheck | None) -> dict[str, Any]:
    """Tell how one of several runs agrees; null where there is only one."""
    if run is None:
        return _unknown_agreement()
    return {
        'agrees': run.agrees,
        'set_aside': run.set_aside,
        'own_effects': run.own_effects,
        'wheel_angles': run.wheel_angles,
        'why': why(run),
        **asdict(run.error),
        'noise_floor': asdict(run.noise_floor),
        'differences': [
            {'parameter': it.name, 'here': _estimate(it.here), 'others': _estimate(it.others)}
            for it in run.differences
        ],
    }


def _unknown_agreement() -> dict[str, Any]:
    """Return the same keys for a run that has no others to agree with."""
    nothing = asdict(ErrorNorm(nan, nan))
    return {
        **dict.fromkeys(('agrees', 'set_aside', 'wheel_angles', 'why')),
        **nothing,
        'noise_floor': nothing,
        'own_effects': [],
        'differences': [],
    }


def _held_out(run: Comparison | None) -> dict[str, Any]:
    return dict.fromkeys(MODELS) if run is None else run_errors(run)


def _plain(value: Any) -> Any:
    """Turn NumPy values into Python's and numbers that JSON lacks into null."""
    if isinstance(value, (np.ndarray, np.generic)):
        value = value.tolist()
    if isinstance(value, dict):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    return None if isinstance(value, float) and not isfinite(value) else value
