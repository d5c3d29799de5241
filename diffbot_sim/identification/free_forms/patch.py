"""A round patch of the floor that is unlike the rest: carpet, water, gravel.

Where it may be is told, before any simulation, by errors of one sense that lie together.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import ceil
from typing import ClassVar

import numpy as np
from scipy.signal import fftconvolve

from diffbot_sim.identification.fitting.views import View
from diffbot_sim.identification.free_forms.forms import Of
from diffbot_sim.records import Array

# Cells along the longer side of the floor, and radii of patches in them.
CELLS, RADII = 64, np.array([2.5, 4.0, 6.0, 8.5, 12.0, 17.0])
# How many patches are tried, and the least share of all that is seen in one, or beyond it.
KEPT, LEAST = 3, 0.02
# A patch begins and ends softly, around its edge [radii].
EDGE, WITHIN = (0.8, 1.2), (1.0, 0.0)
# What is drawn: so many points, as far as this from the middle [radii].
POINTS, DRAWN = 41, 2.0


@dataclass(frozen=True)
class Patch:
    """The same all over a patch and nothing beyond, in proportion to weights."""

    weights: Of
    # Patches of all radii that are as good as apart, generously.
    looked_at: ClassVar[int] = 1000

    def grids(self, views: Sequence[View]) -> list[Array]:
        """Return the middle [m] and the radius [m] of patches, the one that stands out most first.

        None where no pose is known.
        """
        seen = [view for view in views if view.stretch.pose is not None]
        if not seen:
            return []
        places = np.concatenate([wheel_places(view).reshape(-1, 2) for view in seen])
        weights = np.concatenate([self.weights(view).ravel() for view in seen])
        errors = np.concatenate([(view.innovation @ view.mix).ravel() for view in seen])
        return list(_standing_out(places, weights, errors))

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


def _standing_out(places: Array, weights: Array, errors: Array) -> Iterator[Array]:
    """Find patches in which errors in proportion to weights are unlike those beyond.

    Of patches that overlap by much, only the best.
    """
    lowest, side = places.min(axis=0), float(np.ptp(places, axis=0).max())
    if side == 0.0:
        return
    cell = side / CELLS
    at = tuple(((places - lowest) / cell).astype(int).T)
    squares, products = np.zeros((2, CELLS + 1, CELLS + 1))
    np.add.at(squares, at, weights**2)
    np.add.at(products, at, weights * errors)
    power = np.stack([_power(squares, products, radius) for radius in RADII])
    rows, columns = np.indices(squares.shape)
    for _ in range(KEPT):
        size, row, column = np.unravel_index(power.argmax(), power.shape)
        if power[size, row, column] <= 0.0:
            return
        middle = lowest + cell * (np.array([row, column]) + 0.5)
        yield np.append(middle, cell * RADII[size])
        away = np.hypot(rows - row, columns - column)
        power[away < np.maximum(RADII, RADII[size])[:, None, None]] = 0.0


def _power(squares: Array, products: Array, radius: float) -> Array:
    """Return how far errors in a patch around each cell are from all, squared.

    squares: of the weights, products: of weights and errors, in each cell.
    """
    reach = ceil(radius)
    disc = np.hypot(*np.mgrid[-reach : reach + 1, -reach : reach + 1]) <= radius
    inside, told = (fftconvolve(it, disc.astype(float), mode='same') for it in (squares, products))
    share = inside / max(float(squares.sum()), 1.0)
    apart = told - share * products.sum()
    seen = (share > LEAST) & (share < 1.0 - LEAST)
    return np.asarray(seen * apart**2 / np.where(seen, inside * (1.0 - share), 1.0))
