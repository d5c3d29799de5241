"""Free-form forces: piecewise linear or periodic functions of one variable, along one axis."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from diffbot_sim.identification.fitting import Fit, predictions
from diffbot_sim.identification.predictor import Prediction
from diffbot_sim.identification.stretches import Stretch, travel
from diffbot_sim.records import Array

KNOTS, HARMONICS, CURVE_POINTS = 6, 2, 25
PERIODIC = ('heading', 'wheel_angle')
AXES = ('v', 'omega')
# How long a change of the command counts as recent [s].
RECENT = 0.1
# Unit of the amounts: this share of the largest command.
UNIT_SHARE = 0.01


@dataclass(frozen=True)
class Basis:
    """Functions of one variable, evaluated along each stretch.

    axis: 'v' (a force, N) or 'omega' (a torque, N·m); knots: of the variable, empty where it is
    periodic; unit: force or torque that an amount of 1 stands for; values: one array (k, q) for
    each stretch.
    """

    axis: str
    variable: str
    knots: Array
    unit: float
    values: tuple[Array, ...]

    @property
    def size(self) -> int:
        """Number of functions."""
        return int(self.values[0].shape[1])

    def push(self, stretch: int, index: int) -> Array:
        """Return one function as a push on the body, shape (k, 2)."""
        return self.total(np.eye(self.size)[index], stretch)

    def total(self, amounts: Array, stretch: int) -> Array:
        """Return all functions together, in these amounts, as a push, shape (k, 2)."""
        push = np.zeros((len(self.values[stretch]), 2))
        push[:, AXES.index(self.axis)] = self.unit * self.values[stretch] @ amounts
        return push

    def strength(self, amounts: Array) -> float:
        """Return the rms of the force or torque that amounts stand for."""
        force = np.concatenate([values @ amounts for values in self.values])
        return float(self.unit * np.sqrt(np.mean(force**2)))

    def curve(self, amounts: Array, spread: Array) -> tuple[Array, Array, Array]:
        """Return points of the variable, force there, and its standard error."""
        if self.variable in PERIODIC:
            points = np.linspace(-np.pi, np.pi, CURVE_POINTS)
            design = _periodic(points)
        else:
            points, design = self.knots, np.eye(len(self.knots))
        error = np.sqrt(np.maximum(np.einsum('ij,jk,ik->i', design, spread, design), 0.0))
        return points, self.unit * design @ amounts, self.unit * error


def bases(fit: Fit, stretches: Sequence[Stretch], like: Basis | None = None) -> list[Basis]:
    """Return every basis on these stretches; with `like`, its functions alone."""
    found = predictions(fit, stretches)
    unit = UNIT_SHARE * max(float(np.abs(s.run.commands.force).max()) for s in stretches)
    result = []
    for axis in AXES:
        rows = [_terms(fit, s, p, axis) for s, p in zip(stretches, found, strict=True)]
        for name in set.intersection(*(set(row) for row in rows)):
            if like is not None and (axis, name) != (like.axis, like.variable):
                continue
            terms = [row[name] for row in rows]
            everywhere = np.concatenate([term.values.ravel() for term in terms])
            knots = like.knots if like is not None else _knots(name, everywhere)
            evaluated = tuple(_evaluate(name, term, knots) for term in terms)
            lever = fit.model.robot.half_separation if axis == 'omega' else 1.0
            scale = like.unit if like is not None else unit * lever
            if evaluated[0].shape[1] > 0:
                result.append(Basis(axis, name, knots, scale, evaluated))
    return sorted(result, key=lambda basis: (basis.axis, basis.variable))


class _Term(NamedTuple):
    """Where functions of a variable are evaluated and added up: shapes (k, j), weights too."""

    values: Array
    weights: Array


def _terms(fit: Fit, stretch: Stretch, prediction: Prediction, axis: str) -> dict[str, _Term]:
    time, radius = stretch.time, fit.model.robot.wheel_radius
    commands = stretch.run.commands
    force = _held(commands.time, commands.force, time)
    before = _held(commands.time, commands.force, time - RECENT)
    sides = np.array([1.0, 1.0 if axis == 'v' else -1.0])
    plain = {
        'v': prediction.twist[:, 0],
        'omega': prediction.twist[:, 1],
        'heading': stretch.heading,
        'wheel_angle': travel(stretch, prediction.twist)[:, 0] / radius,
        'time': time,
        'traction': force.sum(axis=1),
        'command_change': (force - before).sum(axis=1),
    }
    terms = {name: _Term(x[:, None], np.ones((len(time), 1))) for name, x in plain.items()}
    terms['wheel_force'] = _Term(force, np.broadcast_to(sides, force.shape))
    most = max(float(np.abs(commands.force).max()), 1e-9)
    terms['force_over_time'] = _Term(time[:, None], (force @ sides)[:, None] / most)
    if stretch.pose is not None:
        against = np.sign(prediction.twist[:, [AXES.index(axis)]])
        terms['place_x'] = _Term(stretch.pose[:, [0]], against)
        terms['place_y'] = _Term(stretch.pose[:, [1]], against)
    return terms


def _held(stamps: Array, force: Array, time: Array) -> Array:
    index = np.searchsorted(stamps, time, side='right') - 1
    return np.where(index[:, None] >= 0, force[np.maximum(index, 0)], 0.0)


def _knots(name: str, values: Array) -> Array:
    """Return distinct knots at quantiles; too few of them: the drive does not vary this."""
    if name in PERIODIC:
        return np.empty(0)
    return np.unique(np.quantile(values, np.linspace(0.0, 1.0, KNOTS)))


def _evaluate(name: str, term: _Term, knots: Array) -> Array:
    """Return the functions of a variable along a stretch, shape (k, q)."""
    if name in PERIODIC:
        return _periodic(term.values[:, 0])
    if len(knots) < 3 or knots[-1] - knots[0] < 1e-6:
        return np.empty((len(term.values), 0))
    hats = [np.interp(term.values, knots, hat) for hat in np.eye(len(knots))]
    return np.stack([np.sum(term.weights * hat, axis=1) for hat in hats], axis=1)


def _periodic(values: Array) -> Array:
    waves = [wave(h * values) for h in range(1, HARMONICS + 1) for wave in (np.cos, np.sin)]
    return np.stack(waves, axis=1)
