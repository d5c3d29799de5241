"""How a residual depends on what the robot does: medians over bins, never a fit."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from diffbot_sim.identification.result import Comparison
from diffbot_sim.records import Array

BINS = 30
FEWEST = 8


class Variable(NamedTuple):
    """Something that a residual may depend on: how to label it and where it comes from."""

    label: str
    of: Callable[[Comparison], Array]


@dataclass(frozen=True)
class Curve:
    """Median and quartiles of a quantity over bins of a variable.

    explained: share of the quantity's variance that the bins account for, 0 to 1.
    """

    x: Array
    middle: Array
    low: Array
    high: Array
    explained: float


def heading(run: Comparison) -> Array:
    """Return the heading [°] in (-180, 180]: measured, or simulated where no pose was."""
    yaw = run.with_effects.pose[:, 2] if run.pose is None else run.pose[:, 2]
    return np.degrees(np.arctan2(np.sin(yaw), np.cos(yaw)))


def wheel_angle(run: Comparison) -> Array:
    """Return the right wheel's angle [°] within its turn, 0 to 360."""
    return np.degrees(run.with_effects.wheel_angle[:, 0]) % 360.0


# Simulated speeds: measured ones share their noise with the residual and would fake a slope.
VARIABLES = {
    'v': Variable('speed v [m/s]', lambda run: run.with_effects.twist[:, 0]),
    'omega': Variable('turn rate ω [rad/s]', lambda run: run.with_effects.twist[:, 1]),
    'heading': Variable('heading [°]', heading),
    'wheel_angle': Variable('right wheel angle [°]', wheel_angle),
    'traction': Variable('traction force [N]', lambda run: run.with_effects.traction.sum(axis=1)),
    'time': Variable('time [s]', lambda run: run.time),
}


def residual(run: Comparison, model: str, axis: int) -> Array:
    """Return measured minus simulated v (axis 0) [m/s] or ω (axis 1) [rad/s]."""
    twist: Array = getattr(run, model).twist
    return run.twist[:, axis] - twist[:, axis]


def pooled(runs: tuple[Comparison, ...], of: Callable[[Comparison], Array]) -> Array:
    """Return a quantity of all runs in one row."""
    return np.concatenate([of(run) for run in runs])


def binned(x: Array, y: Array) -> Curve:
    """Describe y over x; bins with few samples are left out."""
    known = np.isfinite(x) & np.isfinite(y)
    x, y = x[known], y[known]
    if len(x) < FEWEST:
        none = np.empty(0)
        return Curve(none, none, none, none, 0.0)
    start, end = np.quantile(x, (0.002, 0.998))
    bins = np.digitize(x, np.linspace(start, end, BINS + 1)[1:-1])
    inside = [bins == number for number in range(BINS)]
    groups = [rows for rows in inside if np.count_nonzero(rows) >= FEWEST]
    centres = np.array([x[rows].mean() for rows in groups])
    parts = [y[rows] for rows in groups]
    quartiles = np.array([np.quantile(part, (0.25, 0.5, 0.75)) for part in parts])
    low, middle, high = quartiles.reshape(-1, 3).T
    return Curve(centres, middle, low, high, _explained(parts))


def _explained(parts: list[Array]) -> float:
    """Adjusted for the number of bins, so that pure noise explains nothing."""
    count = sum(map(len, parts))
    total = float(np.var(np.concatenate(parts))) * count if count > len(parts) else 0.0
    if total <= 0.0:
        return 0.0
    within = sum(float(np.var(part)) * len(part) for part in parts)
    return max(0.0, 1.0 - within / (count - len(parts)) * (count - 1) / total)


def strongest(runs: tuple[Comparison, ...], model: str, axis: int) -> list[str]:
    """Name the variables, the one that explains most of a model's residual first."""
    y = pooled(runs, lambda run: residual(run, model, axis))
    share = {name: binned(pooled(runs, it.of), y).explained for name, it in VARIABLES.items()}
    return sorted(VARIABLES, key=lambda name: -share[name])
