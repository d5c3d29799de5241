"""Forms in which a variable is looked at, whatever the law."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar, Protocol

import numpy as np

from diffbot_sim.identification.fitting.views import View
from diffbot_sim.records import Array

# Numbers of knots: a line, of few functions, shows what is weak; many show what is of any form.
# Bent ones are for what lines do not tell apart: friction at both sides of zero is a line already.
KNOTS, BENT_KNOTS, FEW_KNOTS, FINE_KNOTS = (2, 6), (3, 6), (2, 4), (2, 6, 20)
# What is alike at all times is a gain, or friction, that the model has.
GROWTH_KNOTS = (2, 3, 6)
# What is switched on and off in the course of a run shows in many only.
SWITCHED_KNOTS = (*GROWTH_KNOTS, 20)
# Points by which one turn of an angle is drawn.
TURN_POINTS = 25

# What a variable is at every sample, shape (k,) or (k, 2).
Of = Callable[[View], Array]
# Sets of rates by which an angle is multiplied, for stretches that were seen.
Waves = Callable[[Sequence[View]], Sequence[tuple[float, ...]]]


class Form(Protocol):
    """Functions of a variable, on grids that the drive calls for."""

    @property
    def looked_at(self) -> int:
        """Among how many grids those were chosen that are returned."""

    def grids(self, views: Sequence[View]) -> list[Array]:
        """Return what the functions are laid on (knots, edges, rates), each to be tried alone."""

    def columns(self, view: View, grid: Array, /) -> Array:
        """Return how much of each function is there at every sample of a stretch.

        Shape (k, q, 1) for the body or (k, q, 2) for the right and the left wheel.
        """

    def curve(self, grid: Array, /) -> tuple[Array, Array]:
        """Return points of the variable, shape (n,), and all functions there, shape (n, q)."""


@dataclass(frozen=True)
class Constant:
    """The same at every sample."""

    looked_at: ClassVar[int] = 1

    def grids(self, views: Sequence[View]) -> list[Array]:
        """Return the first and the last moment [s]."""
        ends = np.concatenate([view.stretch.time[[0, -1]] for view in views])
        return [np.array([ends.min(), ends.max()])]

    def columns(self, view: View, ends: Array) -> Array:
        """Return ones along a stretch."""
        del ends
        return np.ones((len(view.stretch.time), 1, 1))

    def curve(self, ends: Array) -> tuple[Array, Array]:
        """Return both ends, and ones there."""
        return ends, np.ones((2, 1))


@dataclass(frozen=True)
class Piecewise:
    """Piecewise linear in a variable, in proportion to weights.

    Knots lie at quantiles of the variable, where it has a weight.
    """

    of: Of
    weights: Of = lambda view: np.ones(1)
    counts: tuple[int, ...] = KNOTS
    looked_at: ClassVar[int] = 1

    def grids(self, views: Sequence[View]) -> list[Array]:
        """Return distinct knots of each number; none where the drive does not vary this."""
        values = np.concatenate([self._weighted(view) for view in views])
        if len(values) == 0 or np.ptp(values) <= 1e-6:
            return []
        spaced = ((n, np.quantile(values, np.linspace(0.0, 1.0, n))) for n in self.counts)
        grids = ((n, np.unique(knots)) for n, knots in spaced)
        return [knots for n, knots in grids if len(knots) >= min(n, 3)]

    def columns(self, view: View, knots: Array) -> Array:
        """Evaluate hats along a stretch."""
        return _hats(self.of(view), knots, self.weights(view))

    def _weighted(self, view: View) -> Array:
        values = self.of(view)
        return np.asarray(values[np.broadcast_to(self.weights(view), values.shape) != 0.0])

    def curve(self, knots: Array) -> tuple[Array, Array]:
        """Return points of the variable and all functions there."""
        return knots, np.eye(len(knots))


@dataclass(frozen=True)
class Growth(Piecewise):
    """The same, less what is alike at all values: nothing in the mean over the quantiles."""

    def columns(self, view: View, knots: Array) -> Array:
        """Evaluate differences of hats along a stretch."""
        hats = super().columns(view, knots)
        return np.asarray(np.einsum('kqc,qr->krc', hats, _differences(len(knots))))

    def curve(self, knots: Array) -> tuple[Array, Array]:
        """Return points of the variable and all functions there."""
        return knots, _differences(len(knots))


@dataclass(frozen=True)
class Pull(Growth):
    """Growth of a pull along the world's x, and of one along its y, as the robot feels them."""

    def columns(self, view: View, knots: Array) -> Array:
        """Evaluate what grows along a stretch, of the pull along x first."""
        grown, heading = super().columns(view, knots), view.stretch.heading[:, None, None]
        return np.concatenate([grown * np.cos(heading), grown * np.sin(heading)], axis=1)


@dataclass(frozen=True)
class Spans:
    """Constant in each span of a variable, in proportion to weights; nothing beyond the last.

    edges: sets of edges, each tried on its own.
    """

    of: Of
    weights: Of
    edges: tuple[tuple[float, ...], ...]
    looked_at: ClassVar[int] = 1

    def grids(self, views: Sequence[View]) -> list[Array]:
        """Return sets of edges, all of whose spans occur."""
        sets = [np.array(edges) for edges in self.edges]
        seen = [np.concatenate([self.columns(view, edges) for view in views]) for edges in sets]
        return [edges for edges, s in zip(sets, seen, strict=True) if np.all(np.any(s, (0, 2)))]

    def columns(self, view: View, edges: Array) -> Array:
        """Evaluate the spans along a stretch."""
        count = len(view.stretch.time)
        values, weights = (of(view).reshape(count, -1) for of in (self.of, self.weights))
        within = [weights * ((values >= a) & (values < b)) for a, b in pairwise(edges)]
        return np.stack(within, axis=1)

    def curve(self, edges: Array) -> tuple[Array, Array]:
        """Return both ends of each span and all functions there."""
        return np.repeat(edges, 2)[1:-1], np.repeat(np.eye(len(edges) - 1), 2, axis=0)


@dataclass(frozen=True)
class TwoSided:
    """Piecewise linear on both sides of zero, where it may jump; nothing at zero itself."""

    of: Of
    looked_at: ClassVar[int] = 1

    def grids(self, views: Sequence[View]) -> list[Array]:
        """Return distinct knots of the size, the same for both sides."""
        return Piecewise(lambda view: np.abs(self.of(view)), counts=BENT_KNOTS).grids(views)

    def columns(self, view: View, knots: Array) -> Array:
        """Evaluate hats along a stretch, the negative side first."""
        values = self.of(view)
        sides = [
            _hats(np.abs(values), knots, np.maximum(side * np.sign(values), 0.0))
            for side in (-1.0, 1.0)
        ]
        return np.concatenate([sides[0][:, ::-1], sides[1]], axis=1)

    def curve(self, knots: Array) -> tuple[Array, Array]:
        """Return points from the negative end to the positive one, and all functions there."""
        return np.concatenate([-knots[::-1], knots]), np.eye(2 * len(knots))


@dataclass(frozen=True)
class Odd:
    """Piecewise linear in the size of a variable, with its sign: alike on both sides of zero."""

    of: Of
    looked_at: ClassVar[int] = 1

    def grids(self, views: Sequence[View]) -> list[Array]:
        """Return distinct knots of the size."""
        return TwoSided(self.of).grids(views)

    def columns(self, view: View, knots: Array) -> Array:
        """Evaluate hats along a stretch, turned round where the variable is negative."""
        values = self.of(view)
        return _hats(np.abs(values), knots, np.sign(values))

    def curve(self, knots: Array) -> tuple[Array, Array]:
        """Return points from the negative end to the positive one, and all functions there."""
        side = np.eye(len(knots))
        return np.concatenate([-knots[::-1], knots]), np.vstack([-side[::-1], side])


@dataclass(frozen=True, kw_only=True)
class Given:
    """Knots that are given, whatever was seen.

    sets: of knots, each tried on its own.
    """

    sets: tuple[tuple[float, ...], ...] = ()

    def grids(self, views: Sequence[View]) -> list[Array]:
        """Return the sets of knots."""
        del views
        return [np.array(knots) for knots in self.sets]


@dataclass(frozen=True)
class Near(Given, Odd):
    """Alike on both sides of zero, with given knots, beyond the last of which it is constant."""


@dataclass(frozen=True)
class Fading(Given, Piecewise):
    """Piecewise linear with given knots, nothing at the last of them and beyond."""

    def columns(self, view: View, knots: Array) -> Array:
        """Evaluate hats along a stretch, but for the last one."""
        return super().columns(view, knots)[:, :-1]

    def curve(self, knots: Array) -> tuple[Array, Array]:
        """Return points of the variable and all functions there."""
        return knots, np.eye(len(knots))[:, :-1]


@dataclass(frozen=True)
class Periodic:
    """Waves in an angle, in proportion to weights: of the heading, a wheel's turn, time.

    waves: sets of rates by which the angle is multiplied; looked_at: among how many sets they were
    chosen.
    """

    of: Of
    waves: Waves = lambda seen: [(1.0, 2.0)]
    looked_at: int = 1
    weights: Of = lambda view: np.ones((1, 1))

    def grids(self, views: Sequence[View]) -> list[Array]:
        """Return the sets of rates to be tried."""
        return [np.array(rates) for rates in self.waves(views)]

    def columns(self, view: View, rates: Array) -> Array:
        """Evaluate waves along a stretch, those of each wheel on their own."""
        angle = self.of(view).reshape(len(view.stretch.time), -1)
        waves = _waves(angle, rates)
        apart = [waves * only for only in np.eye(angle.shape[1])[:, None]]
        return np.concatenate(apart, axis=1) * self.weights(view)[:, None]

    def curve(self, rates: Array) -> tuple[Array, Array]:
        """Return angles of one turn, and the functions of the body or one wheel there."""
        angle = np.linspace(-np.pi, np.pi, TURN_POINTS)
        return angle, _waves(angle[:, None], rates / rates[0])[..., 0]


def _hats(values: Array, knots: Array, weights: Array) -> Array:
    """Return weighted hat functions, shape (k, q, 1 or 2)."""
    hats = [weights * np.interp(values, knots, hat) for hat in np.eye(len(knots))]
    return np.stack([hat.reshape(len(hat), -1) for hat in hats], axis=1)


def _differences(count: int) -> Array:
    """Return what takes hats at quantiles to functions without a mean, shape (n, n - 1)."""
    shares = np.ones(count)
    shares[[0, -1]] = 0.5
    apart = np.diag(1.0 / shares)
    return np.asarray(apart[:, :-1] - apart[:, 1:])


def _waves(angle: Array, rates: Array) -> Array:
    """Return the cosine and the sine of each multiple of angles (k, 1 or 2); of none, one."""
    waves = [wave(rate * angle) for rate in rates if rate for wave in (np.cos, np.sin)]
    return np.stack(waves + [np.ones_like(angle) for rate in rates if not rate], axis=1)
