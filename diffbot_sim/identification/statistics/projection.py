"""What some columns cannot explain of others, by least squares."""

import numpy as np

from diffbot_sim.identification.statistics.robust import influence
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


def apart(errors: Array, free: Array, columns: Array, amounts: Array) -> tuple[Array, Array]:
    """Return errors as they are without some amounts, (n,), and their derivatives, (n, q).

    To first order around whitened errors that have them; of both is taken out what is free.
    free, shape (n, p), columns, shape (n, q): derivatives by what is free, and by the amounts.
    """
    projection = Projection(free)
    columns, left = projection.rest(columns), projection.rest(influence(errors)).ravel()
    return left - columns @ amounts, columns
