"""Robust statistics: a scale that neither a few large errors nor rest decides."""

import numpy as np
import pytest

from diffbot_sim.identification.statistics.robust import scale_of

ERRORS = np.random.default_rng(1).normal(size=(10_000, 2)) * [0.004, 0.03]


def test_scale_of_normal_errors_is_their_deviation() -> None:
    assert scale_of(ERRORS) == pytest.approx([0.004, 0.03], rel=0.03)


def test_a_few_large_errors_hardly_change_the_scale() -> None:
    errors = ERRORS.copy()
    errors[::50] *= 100.0
    assert scale_of(errors) == pytest.approx(scale_of(ERRORS), rel=0.3)


@pytest.mark.parametrize('rest', [0.0, 1e-12, 1e-7])
def test_scale_is_that_of_moving_where_encoders_rest_most_of_the_time(rest: float) -> None:
    errors = ERRORS.copy()
    errors[:7000] = rest
    assert scale_of(errors) == pytest.approx([0.004, 0.03], rel=0.05)


def test_what_makes_no_error_has_a_least_scale() -> None:
    assert np.all(scale_of(np.zeros((100, 2))) > 0.0)
