"""A round patch of the floor that is unlike the rest: carpet, water, gravel."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from diffbot_sim.identification.fitting.views import View
from diffbot_sim.identification.free_forms.forms import Of
from diffbot_sim.identification.free_forms.spotting import (
    Cells,
    Power,
    Spot,
    around,
    gathered,
    wheel_places,
)
from diffbot_sim.records import Array

# The least share of all that is seen in a patch, or beyond it.
LEAST = 0.02
# A patch begins and ends softly, around its edge [radii].
EDGE, WITHIN = (0.8, 1.2), (1.0, 0.0)
# What is drawn: so many points, as far as this from the middle [radii].
POINTS, DRAWN = 41, 2.0


@dataclass(frozen=True)
class Patch(Spot):
    """The same all over a patch and nothing beyond, in proportion to weights."""

    weights: Of

    def power(self, seen: Sequence[View], cells: Cells, errors: Array) -> Power:
        """Return how far errors in a patch are from all, squared."""
        weights = np.concatenate([self.weights(view).ravel() for view in seen])
        squares, products = cells.sums(weights**2), cells.sums(weights * errors)
        return lambda radius: _power(squares, products, radius)

    def columns(self, view: View, patch: Array) -> Array:
        """Evaluate it along a stretch, for each wheel where that wheel is."""
        away = np.linalg.norm(wheel_places(view) - patch[:2], axis=2)
        within = np.interp(away / patch[2], EDGE, WITHIN)
        return np.asarray((within * self.weights(view))[:, None])

    def curve(self, patch: Array) -> tuple[Array, Array]:
        """Return distances from the middle [m], and the function there."""
        away = np.linspace(0.0, DRAWN, POINTS)
        return away * patch[2], np.interp(away, EDGE, WITHIN)[:, None]


def _power(squares: Array, products: Array, radius: float) -> Array:
    """Return it for a radius [cells], from sums of squares and of products with the errors."""
    disc = (np.hypot(*around(radius)) <= 1.0).astype(float)
    inside, told = gathered(squares, disc), gathered(products, disc)
    share = inside / max(float(squares.sum()), 1.0)
    seen = (share > LEAST) & (share < 1.0 - LEAST)
    apart = told - share * products.sum()
    return np.asarray(seen * apart**2 / np.where(seen, inside * (1.0 - share), 1.0))
