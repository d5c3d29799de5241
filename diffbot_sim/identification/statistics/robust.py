"""Robust statistics: a few large errors, as at a stop a sample late, decide nothing."""

import numpy as np

from diffbot_sim.records import Array

# Beyond this many standard deviations an error counts linearly: events cannot dominate.
HUBER = 3.0
# The standard deviation of normal errors is this many times their median size.
NORMAL = 1.4826


def huber(errors: Array) -> Array:
    """Return the robust squares of whitened errors."""
    size = np.abs(errors)
    return np.where(size <= HUBER, size**2, 2.0 * HUBER * size - HUBER**2)


def influence(errors: Array) -> Array:
    """Return how much whitened errors count in robust sums: the derivative of huber, halved."""
    return np.clip(errors, -HUBER, HUBER)


def scale_of(errors: Array) -> Array:
    """Return robust standard deviations of the columns; never zero."""
    middle = np.median(np.abs(errors), axis=0) * NORMAL
    plain = np.sqrt(np.mean(np.clip(errors, -5 * middle - 1e-12, 5 * middle + 1e-12) ** 2, axis=0))
    return np.maximum(np.where(plain > 0, plain, 1e-9), 1e-9)
