"""A round patch of the floor that is unlike the rest: carpet, water, gravel."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from diffbot_sim.identification.fitting.views import View
from diffbot_sim.identification.free_forms.forms import Of
from diffbot_sim.identification.free_forms.spotting import (
    LEAST,
    LOOKED_AT,
    Cells,
    around,
    gathered,
)
from diffbot_sim.records import Array

# A patch begins and ends softly, around its edge [radii].
EDGE, WITHIN = (0.8, 1.2), (1.0, 0.0)
# What is drawn: so many points, as far as this from the middle [radii].
POINTS, DRAWN = 41, 2.0


@dataclass(frozen=True)
class Patch:
    """The same all over a patch and nothing beyond, in proportion to weights."""

    weights: Of
    looked_at: ClassVar[int] = LOOKED_AT

    def grids(self, views: Sequence[View]) -> list[Array]:
        """Return the middle and the radius [m] of patches, the one that stands out most first.

        None where no pose is known.
        """
        seen = [view for view in views if view.stretch.pose is not None]
        if not seen:
            return []
        places = np.concatenate([wheel_places(view).reshape(-1, 2) for view in seen])
        weights = np.concatenate([self.weights(view).ravel() for view in seen])
        errors = np.concatenate([(view.innovation @ view.mix).ravel() for view in seen])
        cells = Cells.of(places)
        squares, products = cells.sums(weights**2), cells.sums(weights * errors)
        return list(cells.spots(lambda radius: _power(squares, products, radius)))

    def columns(self, view: View, patch: Array) -> Array:
        """Evaluate it along a stretch, for each wheel where that wheel is."""
        away = np.linalg.norm(wheel_places(view) - patch[:2], axis=2)
        within = np.interp(away / patch[2], EDGE, WITHIN)
        return np.asarray((within * self.weights(view))[:, None])

    def curve(self, patch: Array) -> tuple[Array, Array]:
        """Return distances from the middle [m], and the function there."""
        away = np.linspace(0.0, DRAWN, POINTS)
        return away * patch[2], np.interp(away, EDGE, WITHIN)[:, None]


def wheel_places(view: View) -> Array:
    """Return where both wheels are [m], the right one first, shape (k, 2, 2).

    Infinitely far off where no pose is known.
    """
    pose = view.stretch.pose
    if pose is None:
        return np.full((len(view.stretch.time), 2, 2), np.inf)
    half, yaw = view.fit.model.half_separation, pose[:, 2]
    to_the_right = half * np.column_stack([np.sin(yaw), -np.cos(yaw)])
    return np.stack([pose[:, :2] + to_the_right, pose[:, :2] - to_the_right], axis=1)


def _power(squares: Array, products: Array, radius: float) -> Array:
    """Return how far errors in a patch around each cell are from all, squared.

    squares: of the weights, products: of weights and errors, in each cell.
    """
    disc = (np.hypot(*around(radius)) <= 1.0).astype(float)
    inside, told = gathered(squares, disc), gathered(products, disc)
    share = inside / max(float(squares.sum()), 1.0)
    seen = (share > LEAST) & (share < 1.0 - LEAST)
    apart = told - share * products.sum()
    return np.asarray(seen * apart**2 / np.where(seen, inside * (1.0 - share), 1.0))
