"""Where on the floor something is, before any simulation: where errors fit it, cell by cell."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from math import ceil
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray
from scipy.signal import fftconvolve

from diffbot_sim.identification.fitting.views import View
from diffbot_sim.records import Array

# Cells along the longer side of the floor, and radii in cells.
CELLS, RADII = 64, np.array([2.5, 4.0, 6.0, 8.5, 12.0, 17.0])
# How many spots are tried.
KEPT = 3
# How well errors fit a spot of a radius [cells] around each cell.
Power = Callable[[float], Array]


@dataclass(frozen=True)
class Cells:
    """The floor in square cells of a width [m] from its lowest corner [m].

    at: the row and the column of every place.
    """

    lowest: Array
    width: float
    at: tuple[NDArray[np.intp], ...]

    @classmethod
    def of(cls, places: Array) -> 'Cells':
        """Divide the floor on which these places are [m], shape (n, 2)."""
        lowest, side = places.min(axis=0), float(np.ptp(places, axis=0).max())
        width = max(side, 1e-6) / CELLS
        return cls(lowest, width, tuple(((places - lowest) / width).astype(int).T))

    def sums(self, amounts: Array) -> Array:
        """Return the sum of the amounts at all places in each cell."""
        total = np.zeros((CELLS + 1, CELLS + 1))
        np.add.at(total, self.at, amounts)
        return total

    def spots(self, power: Power) -> Iterator[Array]:
        """Return middle and radius [m] of the best spots, the best first.

        Of spots one of which has the other's middle in it, only the better one.
        """
        powers = np.stack([power(radius) for radius in RADII])
        rows, columns = np.indices(powers.shape[1:])
        for _ in range(KEPT):
            size, row, column = np.unravel_index(powers.argmax(), powers.shape)
            if powers[size, row, column] <= 0.0:
                return
            middle = self.lowest + self.width * (np.array([row, column]) + 0.5)
            yield np.append(middle, self.width * RADII[size])
            away = np.hypot(rows - row, columns - column)
            powers[away < np.maximum(RADII, RADII[size])[:, None, None]] = 0.0


class Spot(ABC):
    """A form that is laid on a spot of the floor: its middle and its radius [m]."""

    # Spots of all radii that are as good as apart, generously.
    looked_at: ClassVar[int] = 1000

    def grids(self, views: Sequence[View]) -> list[Array]:
        """Return the spots that stand out most, the best first; none where no pose is known."""
        seen = [view for view in views if view.stretch.pose is not None]
        if not seen:
            return []
        cells = Cells.of(np.concatenate([wheel_places(view).reshape(-1, 2) for view in seen]))
        errors = np.concatenate([(view.innovation @ view.mix).ravel() for view in seen])
        return list(cells.spots(self.power(seen, cells, errors)))

    @abstractmethod
    def power(self, seen: Sequence[View], cells: Cells, errors: Array) -> Power:
        """Return how well errors fit this form.

        errors: of the right and the left wheel in turn, like the places that the cells divide.
        """


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


def around(radius: float) -> tuple[Array, Array]:
    """Return how far cells within a square around a cell lie from it, in radii: rows, columns."""
    reach = ceil(radius)
    rows, columns = np.mgrid[-reach : reach + 1, -reach : reach + 1] / radius
    return rows, columns


def gathered(sums: Array, kernel: Array) -> Array:
    """Return for each cell what lies around it, each place weighted by where it lies."""
    return np.asarray(fftconvolve(sums, kernel[::-1, ::-1], mode='same'))
