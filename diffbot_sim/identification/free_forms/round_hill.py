"""What pulls towards a spot of the floor, or away from it: a bump, a hollow, a magnet."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from diffbot_sim.identification.fitting.views import View
from diffbot_sim.identification.free_forms.patch import wheel_places
from diffbot_sim.identification.free_forms.spotting import (
    LEAST,
    LOOKED_AT,
    Cells,
    around,
    gathered,
)
from diffbot_sim.records import Array

# What is drawn: so many points, as far as this from the middle [radii].
POINTS, DRAWN = 41, 1.5


@dataclass(frozen=True)
class RoundHill:
    """The pull of a round hill on each wheel: nothing on its top and beyond its radius."""

    looked_at: ClassVar[int] = LOOKED_AT

    def grids(self, views: Sequence[View]) -> list[Array]:
        """Return the top and the radius [m] of hills, the one that stands out most first.

        None where no pose is known.
        """
        seen = [view for view in views if view.stretch.pose is not None]
        if not seen:
            return []
        cells = Cells.of(np.concatenate([wheel_places(view).reshape(-1, 2) for view in seen]))
        facing = np.repeat(np.concatenate([_facing(view) for view in seen]), 2, axis=0)
        errors = np.concatenate([(view.innovation @ view.mix).ravel() for view in seen])
        products = [cells.sums(along * errors) for along in facing.T]
        squares = [[cells.sums(one * other) for one in facing.T] for other in facing.T]
        return list(cells.spots(lambda radius: _power(squares, products, radius)))

    def columns(self, view: View, hill: Array) -> Array:
        """Evaluate the pull on both wheels along a stretch."""
        if view.stretch.pose is None:
            return np.zeros((len(view.stretch.time), 1, 2))
        place = (wheel_places(view) - hill[:2]) / hill[2]
        outward = np.sum(place * _facing(view)[:, None], axis=2)
        return np.asarray((outward * _steepness(np.linalg.norm(place, axis=2)))[:, None])

    def curve(self, hill: Array) -> tuple[Array, Array]:
        """Return distances from the top [m], and the push away from it there."""
        away = np.linspace(0.0, DRAWN, POINTS)
        return away * hill[2], (away * _steepness(away))[:, None]


def _facing(view: View) -> Array:
    """Return how much of x and of y lies along the robot, shape (k, 2)."""
    heading = view.stretch.heading
    return np.column_stack([np.cos(heading), np.sin(heading)])


def _steepness(away: Array) -> Array:
    """Return how steep (1 − r²)² is over r, at distances of so many radii."""
    return np.maximum(1.0 - away**2, 0.0)


def _power(squares: list[list[Array]], products: list[Array], radius: float) -> Array:
    """Return how well errors fit a hill around each cell.

    squares: in each cell, of what lies along the robot of x and y; products: of that and errors.
    """
    place = around(radius)
    slope = [along * _steepness(np.hypot(*place)) for along in place]
    told = sum(map(gathered, products, slope))
    size = sum(gathered(squares[i][j], slope[i] * slope[j]) for i in range(2) for j in range(2))
    seen = size > LEAST * np.max(size)
    return np.asarray(seen * told**2 / np.where(seen, size, 1.0))
