"""The floor cut into parts: what is said of it must hold on each, like on parts of a run."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.records import Array

Order = NDArray[np.intp]

# Strips across the floor, of as many samples each.
STRIPS = 6


def in_time(stretches: Sequence[Stretch]) -> Order:
    """Return the used samples as they were recorded: indices of shape (n,)."""
    return np.arange(sum(int(np.count_nonzero(stretch.used)) for stretch in stretches))


def by_place(stretches: Sequence[Stretch]) -> Order:
    """Return the used samples in an order in which neighbours lie close together on the floor.

    Indices of shape (n,), along strips to and fro.
    """
    x, y = np.concatenate([_places(stretch)[stretch.used] for stretch in stretches]).T
    strip = np.argsort(np.argsort(x, kind='stable')) * STRIPS // len(x)
    return np.lexsort((np.where(strip % 2, -y, y), strip))


def _places(stretch: Stretch) -> Array:
    """Return where the robot is [m], shape (k, 2); 0 where no pose is known."""
    if stretch.pose is None:
        return np.zeros((len(stretch.time), 2))
    return stretch.pose[:, :2]
