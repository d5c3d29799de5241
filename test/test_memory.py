"""What counts as explained: what past errors do not tell anyway."""

import numpy as np
import pytest
from scipy.signal import lfilter

from diffbot_sim.identification.statistics.memory import (
    fall_of_deviance,
    falls_beyond_past,
)
from diffbot_sim.identification.statistics.robust import huber

RANDOM = np.random.default_rng(3)
WHITE = RANDOM.normal(size=(4000, 2))
COLOURED = np.asarray(lfilter([0.6], [1.0, -0.8], WHITE, axis=0))


def test_what_is_taken_out_of_white_errors_counts_in_full() -> None:
    signal = 0.2 * np.sin(0.7 * np.arange(4000.0))[:, None] * [1.0, 0.5]
    plain = np.sum((WHITE + signal) ** 2) - np.sum(WHITE**2)
    assert fall_of_deviance(WHITE + signal, WHITE) == pytest.approx(plain, rel=0.35)


def test_what_is_taken_out_of_a_few_large_errors_counts_as_in_the_deviance() -> None:
    hits = np.where(np.arange(4000) % 80 == 0, 8.0, 0.0)[:, None]
    plain = np.sum(huber(WHITE + hits)) - np.sum(huber(WHITE))
    assert fall_of_deviance(WHITE + hits, WHITE) == pytest.approx(plain, rel=0.35)


def test_foreseeing_coloured_errors_from_their_past_explains_nothing() -> None:
    foreseen = 0.5 * np.vstack([np.zeros((1, 2)), COLOURED[:-1]])
    assert np.sum(COLOURED**2) - np.sum((COLOURED - foreseen) ** 2) > 500.0
    assert fall_of_deviance(COLOURED, COLOURED - foreseen) < 25.0


def test_differences_of_counts_that_are_foreseen_from_the_last_one_weigh_no_less() -> None:
    differences = np.diff(WHITE, axis=0)
    smaller = differences[1:] + 0.05 * differences[:-1]
    assert np.sum(differences[1:] ** 2) - np.sum(smaller**2) > 500.0
    assert np.all(np.abs(falls_beyond_past(differences[1:], smaller)) < 25.0)


def test_a_worse_fit_explains_nothing() -> None:
    assert fall_of_deviance(WHITE, 1.2 * WHITE) == 0.0


def test_errors_of_what_never_moves_explain_nothing() -> None:
    still = WHITE * [1.0, 0.0]
    assert fall_of_deviance(still, still) == 0.0
    assert np.all(falls_beyond_past(still, still) == 0.0)
