"""Robust statistics: a few large errors, as at a stop a sample late, decide nothing."""

import numpy as np

from diffbot_sim.records import Array

# Beyond this many standard deviations an error counts linearly: events cannot dominate.
HUBER = 3.0
# The standard deviation of normal errors is this many times their median size.
NORMAL = 1.4826
# What is large among errors, as a quantile; what is none beside that, as a share; a least scale.
LARGE, NOTHING, LEAST = 0.95, 1e-3, 1e-9
# Squares of whitened errors that are smaller are rounding: of a robot that never turns, say.
ROUNDING = 1e-12


def huber(errors: Array) -> Array:
    """Return the robust squares of whitened errors."""
    size = np.abs(errors)
    return np.where(size <= HUBER, size**2, 2.0 * HUBER * size - HUBER**2)


def influence(errors: Array) -> Array:
    """Return how much whitened errors count in robust sums: the derivative of huber, halved."""
    return np.clip(errors, -HUBER, HUBER)


def scale_of(errors: Array) -> Array:
    """Return robust standard deviations of the columns; never zero.

    Of what is an error at all: encoders of a robot that stands make none, and it may stand mostly.
    """
    return np.asarray(np.apply_along_axis(_scale, 0, np.abs(errors)))


def _scale(size: Array) -> float:
    told = size[size > NOTHING * np.quantile(size, LARGE)]
    if not told.size:
        return LEAST
    limit = 5.0 * NORMAL * np.median(told)
    return max(float(np.sqrt(np.mean(np.minimum(told, limit) ** 2))), LEAST)
