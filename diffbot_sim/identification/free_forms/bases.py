"""Free-form forces: functions of one variable, along one axis, on given stretches."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from math import inf

import numpy as np

from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.fitting.views import View, views
from diffbot_sim.identification.free_forms.variables import TOLD, VARIABLES
from diffbot_sim.identification.recordings.stretches import Stretch, largest_command
from diffbot_sim.identification.statistics.norms import rms
from diffbot_sim.records import Array

# Unit of the amounts: this share of the largest command.
UNIT_SHARE = 0.01
# The wheels' forces as a force along x and, times half the separation, as a torque.
ON_BODY = {
    'v': np.array([[1.0, 0.0]]),
    'omega': np.array([[0.0, 1.0]]),
    'wheels': np.array([[1.0, 1.0], [1.0, -1.0]]),
    'difference': np.array([[1.0, 1.0], [-1.0, 1.0]]),
}


@dataclass(frozen=True)
class Basis:
    """Functions of one variable, evaluated along each stretch.

    axis: 'v' (a force along the robot), 'omega' (a torque), 'wheels' (a force on each wheel, by
    one law) or 'difference' (the left wheel's is the opposite); grid: what the functions depend on
    besides, such as knots; unit: force [N] that an amount of 1 stands for; lever: half the wheel
    separation [m]; values: one array (k, q, 1 or 2) for each stretch.
    """

    axis: str
    variable: str
    grid: Array
    unit: float
    lever: float
    values: tuple[Array, ...]

    @property
    def size(self) -> int:
        """Number of functions."""
        return int(self.values[0].shape[1])

    @property
    def words(self) -> str:
        """What the functions depend on."""
        rate = float(self.grid[0])
        return VARIABLES[self.variable].words.format(
            grid=self.grid, rate=rate, period=1.0 / rate if rate else inf
        )

    def parted(self, rows: Array, stretches: Sequence[Stretch]) -> Array:
        """Put a row for v and ω of every used sample in the order in which parts must agree."""
        order = VARIABLES[self.variable].order(stretches)
        pairs = rows.reshape(len(order), 2, *rows.shape[1:])
        return np.asarray(pairs[order].reshape(rows.shape))

    def push(self, stretch: int, index: int) -> Array:
        """Return one function as a push on the body, shape (k, 2)."""
        return self.total(np.eye(self.size)[index], stretch)

    def total(self, amounts: Array, stretch: int) -> Array:
        """Return all functions together, in these amounts, as a push, shape (k, 2)."""
        force = np.einsum('kqc,q->kc', self.values[stretch], amounts)
        return np.asarray(self.unit * force @ ON_BODY[self.axis] * [1.0, self.lever])

    def pushed(self, stretches: Sequence[Stretch], amounts: Array) -> tuple[Stretch, ...]:
        """Return its stretches, pushed by all functions together, in these amounts."""
        return tuple(s.pushed(self.total(amounts, index)) for index, s in enumerate(stretches))

    def strength(self, amounts: Array) -> float:
        """Return the rms of the force [N], or torque [N·m], that amounts stand for."""
        return self.scale * rms(self._force(amounts))

    def strengths(self, amounts: Array) -> dict[str, float]:
        """Return the same of each part that has functions of its own."""
        count = len(VARIABLES[self.variable].parts)
        alone = np.repeat(np.eye(count), self.size // count, axis=1) * amounts
        # A wheel's own functions push that one alone.
        sizes = [np.max(np.sqrt(np.mean(self._force(own) ** 2, axis=0))) for own in alone]
        return dict(zip(VARIABLES[self.variable].parts, self.scale * np.array(sizes), strict=True))

    def _force(self, amounts: Array) -> Array:
        return np.concatenate([np.einsum('kqc,q->kc', v, amounts) for v in self.values])

    @property
    def scale(self) -> float:
        """Force [N], or torque [N·m] along omega, that an amount of 1 stands for."""
        return self.unit * (self.lever if self.axis == 'omega' else 1.0)

    def curve(self, amounts: Array, spread: Array, part: str) -> tuple[Array, Array, Array]:
        """Return points of the variable, force of a part there, and its standard error."""
        points, design = VARIABLES[self.variable].form.curve(self.grid)
        first = design.shape[1] * VARIABLES[self.variable].parts.index(part)
        shown = slice(first, first + design.shape[1])
        covariance = np.einsum('ij,jk,ik->i', design, spread[shown, shown], design)
        error = np.sqrt(np.maximum(covariance, 0.0))
        return points, self.scale * design @ amounts[shown], self.scale * error


def bases(fit: Fit, stretches: Sequence[Stretch], names: Iterable[str] = TOLD) -> list[Basis]:
    """Return every basis of these variables, or of all that are told, on these stretches."""
    seen = views(fit, stretches)
    unit = UNIT_SHARE * largest_command(stretches)
    return [
        Basis(axis, name, grid, unit, fit.model.half_separation, columns)
        for name, grid, columns in _evaluated(seen, names)
        for axis in VARIABLES[name].axes
    ]


def again(like: Basis, fit: Fit, stretches: Sequence[Stretch]) -> Basis:
    """Return the functions of a basis as another fit sees them, on any stretches."""
    form = VARIABLES[like.variable].form
    columns = tuple(form.columns(view, like.grid) for view in views(fit, stretches))
    return Basis(like.axis, like.variable, like.grid, like.unit, like.lever, columns)


def _evaluated(
    views: Sequence[View], names: Iterable[str]
) -> Iterator[tuple[str, Array, tuple[Array, ...]]]:
    for name in names:
        form = VARIABLES[name].form
        for grid in form.grids(views):
            yield name, grid, tuple(form.columns(view, grid) for view in views)
