"""Whether twists are older than their stamps, or the robot is late."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from counting import counted, driven
from fits import fitted, leaving, without_pose

from diffbot_sim.identification.fitting.coordinates import Space, point_of
from diffbot_sim.identification.fitting.fit import FIRST_GAINS, Fit
from diffbot_sim.identification.older import Ages, Older, is_taken
from diffbot_sim.identification.recordings.lateness import (
    TWIST,
    of_interval_before,
    speed_of_interval_before,
)
from diffbot_sim.identification.recordings.recordings import Recordings
from diffbot_sim.identification.selection.evidence import delta_bic_beyond_past
from diffbot_sim.identification.statistics.guards import VERY_STRONG
from diffbot_sim.identification.statistics.memory import falls_beyond_past
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects.actuator_delay import ActuatorDelay


def fit_of(delay: float = 0.0) -> Fit:
    """Return a fit of twists that come every 20 ms, of a robot with that delay [s]."""
    late = [(ActuatorDelay, point_of(ActuatorDelay, [delay]))] if delay else []
    space = Space(Model(), tuple(kind for kind, _ in late))
    at = np.concatenate([Space(Model(), ()).prior(), *(point for _, point in late)])
    stretches: Any = (SimpleNamespace(time=np.arange(0.0, 1.0, 0.02)),)
    return Fit(space, stretches, at, FIRST_GAINS, np.ones(2))


def means_are_taken(worth: float, unexplained: float = 0.0, delay: float = 0.03) -> bool:
    """Say whether means are taken, beside a late robot that explains more or less than they do."""
    weighed = [lambda first, second: worth] * 2
    means = Older('twists', TWIST, of_interval_before, *weighed)
    return is_taken(means, fit_of(delay), fit_of(), unexplained)


@pytest.mark.parametrize(('worth', 'taken'), [(30.0, True), (-5.0, True), (-30.0, False)])
def test_means_are_taken_where_they_explain_as_much_as_a_late_robot(worth, taken):
    assert means_are_taken(worth) == taken


@pytest.mark.parametrize(('worth', 'taken'), [(-30.0, True), (-60.0, False)])
def test_beside_a_force_without_a_name_they_may_explain_a_little_less(worth, taken):
    assert means_are_taken(worth, unexplained=800.0) == taken


@pytest.mark.parametrize(('delay', 'taken'), [(0.0098, True), (0.013, False)])
def test_beside_it_a_robot_that_is_as_late_as_means_are_is_no_evidence(delay, taken):
    assert means_are_taken(-60.0, unexplained=800.0, delay=delay) == taken


def test_sums_of_counts_that_a_fit_left_to_chance_decide_nothing() -> None:
    counts = np.random.default_rng(1).normal(0.0, 0.7, (5000, 2))
    first = np.diff(counts, axis=0)
    # Next to nothing beside the noise of a sample, but it adds up, and counts do not.
    second = first + 0.02 * np.sin(np.arange(len(first)) / 500.0)[:, None]
    assert np.all(falls_beyond_past(first, second) < -30.0)
    assert delta_bic_beyond_past(leaving(first), leaving(second)) > -VERY_STRONG


def test_run_that_is_known_for_means_keeps_no_other_from_being_taken_so() -> None:
    known, unsure = (counted(driven(Model(), seed), 1) for seed in (2, 4))
    fit, _ = fitted(known)
    both = Recordings((of_interval_before(known), without_pose(unsure)), ())
    assert [it.what for it in Ages(fit, both).likely][:1] == ['twists']


def test_run_whose_pose_denies_it_keeps_all_from_being_taken_for_means() -> None:
    unsure, validate = without_pose(counted(driven(Model()), 1)), driven(Model(), 4)
    fit, _ = fitted(unsure)
    assert Ages(fit, Recordings((unsure,), (validate,))).likely == []


def test_means_of_counts_beside_a_gyro_leave_counts_as_they_are() -> None:
    known = of_interval_before(counted(driven(Model()), 1))
    assert speed_of_interval_before(known).odometry.means == (True, True)
