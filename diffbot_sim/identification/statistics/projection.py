"""What some columns cannot explain of others, by least squares."""

import numpy as np

from diffbot_sim.records import Array

# Columns shorter than this say nothing.
SHORTEST = 1e-9


class Projection:
    """Takes out of values what the columns of a matrix, shape (n, p), explain."""

    def __init__(self, columns: Array) -> None:
        size = np.linalg.norm(columns, axis=0)
        kept = columns[:, size > SHORTEST] / size[size > SHORTEST]
        self._basis = np.linalg.svd(kept, full_matrices=False)[0]

    def rest(self, values: Array) -> Array:
        """Return what is left of values whose first axes hold n samples, in the same shape."""
        flat = values.reshape(self._basis.shape[0], -1)
        return np.asarray(flat - self._basis @ (self._basis.T @ flat)).reshape(values.shape)
