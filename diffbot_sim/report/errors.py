"""The four errors, side by side: declared, recalibrated, with effects, noise floor."""

from dataclasses import asdict, dataclass
from math import nan

from diffbot_sim.identification.result import (
    Comparison,
    ErrorNorm,
    Errors,
    Identification,
)
from diffbot_sim.identification.statistics.norms import norm

LABELS = {
    'declared': 'declared',
    'recalibrated': 'recalibrated',
    'with_effects': 'with effects',
    'noise_floor': 'noise floor',
}
MODELS = ('declared', 'recalibrated', 'with_effects')


@dataclass(frozen=True)
class ErrorRow:
    """One row of the table of errors: v [mm/s], ω [mrad/s], and both over the noise floor."""

    key: str
    label: str
    v: float
    omega: float
    v_ratio: float
    omega_ratio: float


def error_rows(errors: Errors) -> list[ErrorRow]:
    """List the errors in the order in which a model gets better."""
    floor = errors.noise_floor
    return [_row(key, getattr(errors, key), floor) for key in LABELS]


def _row(key: str, error: ErrorNorm, floor: ErrorNorm) -> ErrorRow:
    v_ratio = ratio(error.v_rmse, floor.v_rmse)
    omega_ratio = ratio(error.omega_rmse, floor.omega_rmse)
    v, omega = 1e3 * error.v_rmse, 1e3 * error.omega_rmse
    return ErrorRow(key, LABELS[key], v, omega, v_ratio, omega_ratio)


def ratio(error: float, floor: float) -> float:
    """Return an error over the noise floor, nan where there is no noise."""
    return error / floor if floor > 0.0 else nan


@dataclass(frozen=True)
class HorizonRow:
    """One row of the table of horizons: each model's error in v [mm/s] and in ω [mrad/s]."""

    name: str
    v: list[float]
    omega: list[float]


def horizon_rows(result: Identification) -> list[HorizonRow]:
    """List the errors by how far ahead was predicted, for the models shown."""
    rows = []
    for horizon in result.horizons:
        left: list[ErrorNorm] = [getattr(horizon, model) for model in models_shown(result)]
        v, omega = [1e3 * it.v_rmse for it in left], [1e3 * it.omega_rmse for it in left]
        rows.append(HorizonRow(horizon.name, v, omega))
    return rows


def models_shown(result: Identification) -> tuple[str, ...]:
    """Name the models worth drawing: where nothing was added, the last two are one."""
    return MODELS[:2] if result.identified == result.recalibrated else MODELS


def run_errors(run: Comparison) -> dict[str, dict[str, float]]:
    """Return each model's error [m/s, rad/s] on one held-out stretch."""
    return {key: asdict(norm(run.twist - getattr(run, key).twist)) for key in MODELS}
