"""How large errors are, and how large those of a perfect model would be."""

from collections.abc import Sequence
from math import inf

import numpy as np

from diffbot_sim.identification.result import ErrorNorm
from diffbot_sim.records import Array

# Distinct values [m/s, rad/s] closer than this are one, apart by rounding.
SAME = 1e-9
# White noise gives second differences of this many times its deviation.
SECOND = np.sqrt(6.0)
# What lies so many spreads away is no noise, and how often the spread is taken without that.
FAR, CLIPS = 5.0, 10


def norm(errors: Array) -> ErrorNorm:
    """Return root mean squares of the columns v and ω."""
    return ErrorNorm.of(rms_of_each(errors))


def rms_of_each(values: Array) -> Array:
    """Return the root mean square of each column, shape (2,) of v and ω."""
    return np.asarray(np.sqrt(np.mean(values**2, axis=0)))


def rms(values: Array) -> float:
    """Return the root mean square of all values, 0 of none."""
    return float(np.sqrt(np.mean(values**2))) if values.size else 0.0


def noise_floor(twists: Sequence[Array], models: Sequence[Array]) -> ErrorNorm:
    """Return what measurement noise leaves of a perfect model.

    twists: measured, one array (n, 2) for each stretch; models: what a model has there. White
    noise, or what the steps of a coarse encoder stand for where that is more.
    """
    white = np.concatenate([_white(t - m) for t, m in zip(twists, models, strict=True)])
    coarse = resolution(np.concatenate(twists)) / np.sqrt(12.0)
    return ErrorNorm.of(np.maximum(rms_of_each(white), coarse))


def white_noise(twist: Array) -> Array:
    """Return the white noise of a measured twist (n, 2), which moves smoothly; shape (2,)."""
    return rms_of_each(_white(twist))


def _white(errors: Array) -> Array:
    """Return what white noise leaves in the second differences, scaled back.

    Model errors are smooth from sample to sample and vanish there. The few largest, where a stop
    is a sample early or late, are left out: measured by the spread of the others, of which most
    may be 0, as those of an encoder are at rest.
    """
    noise = np.diff(errors, n=2, axis=0) / SECOND
    limit = np.full(noise.shape[1], inf)
    for _ in range(CLIPS):
        kept = np.abs(noise) <= limit
        spread = np.sqrt(np.sum(noise**2 * kept, axis=0) / np.maximum(kept.sum(axis=0), 1))
        limit = FAR * spread
    return np.where(np.abs(noise) <= limit, noise, 0.0)


def resolution(twist: Array) -> Array:
    """Return the smallest steps in which v and ω are told, shape (2,): next to 0 for noise."""
    steps = [np.diff(np.unique(np.round(column / SAME))) * SAME for column in twist.T]
    return np.array([step.min() if step.size else 0.0 for step in steps])
