"""NPZ: one array for each column, read by numpy.load."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from diffbot_sim.records import Array


def write(path: Path, columns: Mapping[str, Array]) -> None:
    """Write a table; equal columns make equal bytes."""
    arrays: dict[str, Any] = dict(columns)
    np.savez_compressed(path, **arrays)
