"""What pulls towards a spot of the floor, or away from it: a bump, a hollow, a magnet."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np

from diffbot_sim.identification.fitting.views import View
from diffbot_sim.identification.free_forms.quantities import towards
from diffbot_sim.identification.free_forms.spotting import (
    Cells,
    Power,
    Spot,
    around,
    gathered,
    wheel_places,
)
from diffbot_sim.records import Array

# The least that is seen of a hill, as a share of the hill of its radius that is seen best.
LEAST = 0.02
# What is drawn: so many points, as far as this from the top [radii].
POINTS, DRAWN = 41, 1.5


@dataclass(frozen=True)
class RoundHill(Spot):
    """The pull of a round hill on each wheel: nothing on its top and beyond its radius."""

    def power(self, seen: Sequence[View], cells: Cells, errors: Array) -> Power:
        """Return by how much a hill lowers the squares of the errors."""
        facing = np.repeat(np.concatenate([_facing(view) for view in seen]), 2, axis=0).T
        products = [cells.sums(along * errors) for along in facing]
        squares = [[cells.sums(one * other) for one in facing] for other in facing]
        return lambda radius: _power(squares, products, radius)

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
    return np.column_stack([towards(index)(view) for index in (0, 1)])


def _steepness(away: Array) -> Array:
    """Return how steep (1 − r²)² is over r, at distances of so many radii."""
    return np.maximum(1.0 - away**2, 0.0)


def _power(squares: list[list[Array]], products: list[Array], radius: float) -> Array:
    """Return it for a radius [cells], from what lies along the robot of x and y in each cell.

    squares: of both with both; products: of both with the errors.
    """
    place = around(radius)
    slope = [along * _steepness(np.hypot(*place)) for along in place]
    told: Array = np.sum([gathered(*pair) for pair in zip(products, slope, strict=True)], axis=0)
    size: Array = np.sum(
        [gathered(squares[i][j], slope[i] * slope[j]) for i, j in product((0, 1), repeat=2)],
        axis=0,
    )
    seen = size > LEAST * size.max()
    return np.asarray(seen * told**2 / np.where(seen, size, 1.0))
