"""Pushes at a few moments, told from rough floors and from what only looks like them."""

import warnings
from dataclasses import replace

import numpy as np
import pytest
from fits import ROUGH, SMOOTH, acted_otherwise, fitted
from rehearsal import Surroundings, random_forces

from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.fitting.response import Response, responses
from diffbot_sim.identification.fitting.views import View, views
from diffbot_sim.identification.free_forms import moments
from diffbot_sim.identification.free_forms.moments import (
    OUTSTANDING,
    find_moments,
    find_outstanding,
    pushed,
    standing_out,
)
from diffbot_sim.records import Array, Run

DRIVE = random_forces(5, 80.0, 2.0, 14.0)


def rolling(around: Surroundings, *pushes: tuple[float, float]) -> Run:
    """Return a drive that hardly stops, pushed along at times [s] by forces [N] for 0.5 s."""
    force = DRIVE.force.copy()
    for time, push in pushes:
        force[(DRIVE.time >= time) & (DRIVE.time < time + 0.5)] += 0.5 * push
    return acted_otherwise(DRIVE, force, around, 5)


def with_holes(run: Run) -> Run:
    """Return a run whose odometry misses two seconds around every twentieth."""
    seen = run.odometry
    kept = np.abs(seen.time % 20.0 - 10.0) < 9.0
    holes = replace(seen, time=seen.time[kept], twist=seen.twist[kept], pose=seen.pose[kept])
    return replace(run, odometry=holes)


def fit_of(run: Run) -> Fit:
    """Return a fit of the plain model."""
    fit, _ = fitted(run)
    return fit


@pytest.mark.parametrize('around', [SMOOTH, ROUGH])
def test_pushes_are_told_with_their_moments_and_signs(around: Surroundings) -> None:
    left = pushed(fit_of(rolling(around, (21.0, 12.0), (43.0, -12.0))))
    assert left is not None
    assert left.variable == 'time_of_push'
    first, second = left.force[np.searchsorted(left.knots, (21.1, 43.1))]
    assert (first, second) == pytest.approx((12.0, -12.0), abs=2.5)


def test_push_that_swells_and_fades_is_told_with_its_force() -> None:
    force, since = DRIVE.force.copy(), DRIVE.time - 21.0
    swelling = 14.0 * np.sin(np.pi * np.clip(since / 4.0, 0.0, 1.0))
    left = pushed(fit_of(acted_otherwise(DRIVE, force + 0.5 * swelling[:, None], SMOOTH, 5)))
    assert left is not None
    assert left.force[np.searchsorted(left.knots, 23.0)] == pytest.approx(14.0, abs=2.0)


@pytest.mark.parametrize('around', [SMOOTH, ROUGH])
def test_nobody_pushes_a_robot_that_is_left_alone(around: Surroundings) -> None:
    fit = fit_of(rolling(around))
    assert find_moments(fit) == []
    assert find_outstanding(fit) == []


def test_gusts_that_a_noise_model_follows_stand_out_of_what_it_follows() -> None:
    gusts = (12.0, 30.0, 50.0)
    blown = np.maximum(np.sin(np.pi * (DRIVE.time[:, None] - gusts) / 4.0), 0.0)
    lasting = np.abs(DRIVE.time[:, None] - gusts - 2.0) < 2.0
    force = DRIVE.force + 5.0 * np.sum(blown * lasting, axis=1, keepdims=True)
    fit = fit_of(acted_otherwise(DRIVE, force, ROUGH, 5))
    found, left = find_outstanding(fit), standing_out(fit)
    assert left is not None
    assert left.worth > 2.0 * OUTSTANDING**2
    assert sorted(moment.time for moment in found) == pytest.approx(np.add(gusts, 2.0), abs=1.0)
    assert {moment.axis for moment in found} == {0}


@pytest.mark.parametrize(('known_to', 'stand_out'), [(1.0, True), (20.0, False)])
def test_force_that_is_hardly_felt_does_not_stand_out(
    monkeypatch: pytest.MonkeyPatch, known_to: float, stand_out: bool
) -> None:
    """Two windows hold ten times the usual error; there it is that, or twenty times as much."""
    real = moments.over_time

    def with_two(view: View, response: Response, axis: int) -> Array:
        knots, force, error = real(view, response, axis)
        rows, usual = [10, -10], np.median(error)
        force, error = 0.1 * force, error.copy()
        force[rows], error[rows] = 10.0 * usual, known_to * usual
        return np.stack([knots, force, error])

    monkeypatch.setattr(moments, 'over_time', with_two)
    assert bool(find_outstanding(fit_of(rolling(SMOOTH)))) == stand_out


def test_one_push_must_be_as_sure_as_two() -> None:
    weak, strong = (fit_of(rolling(SMOOTH, (21.0, force))) for force in (0.1, 12.0))
    assert len(find_moments(weak)) == len(find_moments(strong)) == 1
    assert pushed(weak) is None
    assert pushed(strong) is not None


def test_what_odometry_missed_is_no_push_where_it_comes_back() -> None:
    run = rolling(ROUGH, (20.4, 6.0), (40.4, 6.0))
    assert find_moments(fit_of(with_holes(run))) == []


def test_force_over_time_is_told_around_what_odometry_missed() -> None:
    fit = fit_of(with_holes(rolling(SMOOTH)))
    (view,), (response,) = views(fit, fit.stretches), responses(fit)
    with warnings.catch_warnings():
        warnings.simplefilter('error')  # of means of nothing
        knots, force, _ = moments.over_time(view, response, 0)
    assert np.isfinite(force).all()
    assert np.min(np.abs(knots[:, None] - [20.0, 40.0])) > 0.5


def test_outlier_is_no_push() -> None:
    run = rolling(SMOOTH)
    twist = run.odometry.twist.copy()
    twist[[900, 1700, 2300]] += 1.0
    outliers = replace(run.odometry, twist=twist)
    assert find_moments(fit_of(replace(run, odometry=outliers))) == []
