"""report.json: the answer for programs. Keys and nesting are fixed; more may be added."""

import json
from dataclasses import asdict
from math import isfinite
from typing import Any

import numpy as np

from diffbot_sim.identification.result import Estimate, FoundEffect, Identification
from diffbot_sim.report.errors import run_errors


def json_text(result: Identification) -> str:
    """Write the answer as JSON: full precision, SI units, null for what is not a number."""
    plain = _plain(as_dict(result))
    return json.dumps(plain, indent=2, ensure_ascii=False, allow_nan=False) + '\n'


def as_dict(result: Identification) -> dict[str, Any]:
    """Lay the answer out in the form of report.json."""
    return {
        'verdict': result.verdict,
        'effects': [_effect(effect) for effect in result.effects],
        'unexplained': None if result.unexplained is None else asdict(result.unexplained),
        'nominal': {'parameters': _estimates(result.nominal)},
        'error': asdict(result.errors),
        'candidates': [asdict(candidate) for candidate in result.candidates],
        'advice': list(result.advice),
        'runs': [{'name': run.run, **run_errors(run)} for run in result.comparisons],
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
    return {
        name: {'value': it.value, 'ci95': [it.low, it.high], 'unit': it.unit}
        for name, it in estimates.items()
    }


def _plain(value: Any) -> Any:
    """Turn NumPy values into Python's and numbers that JSON lacks into null."""
    if isinstance(value, (np.ndarray, np.generic)):
        value = value.tolist()
    if isinstance(value, dict):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    return None if isinstance(value, float) and not isfinite(value) else value
