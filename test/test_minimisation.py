"""Robust least squares that settles with the scale of its errors."""

import numpy as np
import pytest

from diffbot_sim.identification.statistics.minimisation import (
    DIFFERENCE,
    Prior,
    derivatives,
    minimise,
)

FAR = (np.full(2, -9.0), np.full(2, 9.0))
VAGUE = Prior(np.zeros(2), np.full(2, 1e6))
NOISE = np.random.default_rng(0).normal(size=(20_000, 2))


def valley(at):
    """Return noise whose scale hardly tells how far the point is from (1, 1), by a bent way."""
    errors = NOISE.copy()
    errors[::2, 0] += 0.6 * (at[1] - at[0] ** 2)
    errors[::2, 1] += 0.03 * (1.0 - at[0])
    return errors


def test_fit_goes_on_to_the_minimum_though_the_scale_has_settled() -> None:
    start = np.array([-1.2, 1.44])
    short, _ = minimise(valley, start, VAGUE, FAR, evaluations=3, rounds=60)
    long, _ = minimise(valley, start, VAGUE, FAR, evaluations=300, rounds=60)
    assert short == pytest.approx(long, abs=0.2)  # a third of what the noise leaves open


def test_start_far_beyond_bounds_is_brought_within() -> None:
    point, _ = minimise(valley, np.full(2, 1e12), VAGUE, FAR, evaluations=3, rounds=1)
    assert np.all((FAR[0] <= point) & (point <= FAR[1]))


def test_no_point_is_asked_for_twice() -> None:
    asked = []

    def errors(at):
        asked.append(tuple(at))
        return valley(at)

    minimise(errors, np.array([-1.2, 1.0]), VAGUE, FAR, evaluations=20, rounds=3)
    assert len(set(asked)) == len(asked)


def test_derivatives_where_a_fit_ends_are_not_asked_for() -> None:
    asked = []

    def errors(at):
        asked.append(at)
        return valley(at)

    point, _ = minimise(errors, np.array([-1.2, 1.0]), VAGUE, FAR, evaluations=20, rounds=2)
    beside = [at for at in asked if 0.0 < np.abs(at - point).max() < 2.0 * DIFFERENCE]
    assert not beside


@pytest.mark.parametrize('side', [-1.0, 1.0])
def test_jump_beside_a_point_is_no_slope(side) -> None:
    def errors(at):
        found = NOISE * at
        found[7] += 0.5 * (side * (at[0] - 1.0) > 1e-9)  # a wheel that then breaks away
        return found

    point = np.ones(2)
    slopes = derivatives(errors, point, errors(point), FAR)
    assert slopes[..., 0] == pytest.approx(NOISE * [1.0, 0.0], abs=1e-6)


@pytest.mark.parametrize('end', FAR)
def test_nothing_is_asked_for_beyond_bounds(end) -> None:
    def errors(at):
        assert np.all((FAR[0] <= at) & (at <= FAR[1]))
        return NOISE * at + 9.0 * (at[0] != end[0])  # a jump: both sides would be looked at

    slopes = derivatives(errors, end, errors(end), FAR)
    assert np.isfinite(slopes).all()


def test_scale_is_that_of_the_errors_and_events_count_little() -> None:
    def errors(at):
        found = 0.1 * NOISE + at
        found[:200] += 50.0
        return found

    point, sigma = minimise(errors, np.ones(2), VAGUE, FAR, evaluations=20, rounds=5)
    assert sigma == pytest.approx([0.1, 0.1], rel=0.2)
    assert np.abs(point).max() < 0.03
