"""Structures that are told apart, and those that are not."""

import numpy as np
from fits import leaving

from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.selection.rivals import is_told_apart
from diffbot_sim.records import Array

SAMPLES = 2000
NOISE = np.random.default_rng(1).normal(size=(SAMPLES, 2))


def erring(more: Array) -> Fit:
    """Return a fit of which each squared error is larger by so much, shape (n,)."""
    return leaving(np.sqrt(NOISE**2 + 0.5 * more[:, None]))


def spread(total: float) -> Array:
    return np.full(SAMPLES, total / SAMPLES)


def at_a_stop(total: float) -> Array:
    return np.where(np.arange(SAMPLES) // 20 == 40, total / 20, 0.0)


def test_what_differs_by_little_is_not_told_apart() -> None:
    assert not is_told_apart(erring(spread(8.0)), erring(spread(0.0)))


def test_what_differs_by_more_must_do_so_all_along_the_runs() -> None:
    assert is_told_apart(erring(spread(15.0)), erring(spread(0.0)))
    assert not is_told_apart(erring(at_a_stop(15.0)), erring(spread(0.0)))


def test_what_differs_by_far_is_told_apart_by_a_single_stop() -> None:
    assert is_told_apart(erring(at_a_stop(40.0)), erring(spread(0.0)))
