"""Whether twists are older than their stamps, or the robot is late."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from diffbot_sim.identification.fitting.coordinates import Space
from diffbot_sim.identification.fitting.fit import FIRST_GAINS, UNIT, Fit
from diffbot_sim.identification.older import Older, is_taken
from diffbot_sim.identification.recordings.lateness import TWIST, of_interval_before
from diffbot_sim.identification.selection.evidence import delta_bic_beyond_past
from diffbot_sim.identification.selection.rivals import INDISTINGUISHABLE
from diffbot_sim.identification.statistics.memory import falls_beyond_past
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects.actuator_delay import ActuatorDelay
from diffbot_sim.records import Array


def fit_of(*kinds: type) -> Fit:
    space = Space(Model(), kinds)
    return Fit(space, (), space.prior() + 0.5, FIRST_GAINS, UNIT)


def means_are_taken(worth: float, unexplained: float = 0.0) -> bool:
    """Say whether means are taken, beside a late robot that explains more or less than they do."""
    weighed = [lambda first, second: worth] * 2
    means = Older('twists', TWIST, of_interval_before, *weighed)
    return is_taken(means, fit_of(ActuatorDelay), fit_of(), unexplained)


@pytest.mark.parametrize(('worth', 'taken'), [(30.0, True), (-5.0, True), (-30.0, False)])
def test_means_are_taken_where_they_explain_as_much_as_a_late_robot(worth, taken):
    assert means_are_taken(worth) == taken


@pytest.mark.parametrize(('worth', 'taken'), [(-30.0, True), (-60.0, False)])
def test_beside_a_force_without_a_name_they_may_explain_a_little_less(worth, taken):
    assert means_are_taken(worth, unexplained=800.0) == taken


def leaving(errors: Array) -> Any:
    """Return what is compared of a fit that leaves these errors."""
    return SimpleNamespace(whitened=errors, sigma=np.ones(2), u=np.zeros(1))


def test_sums_of_counts_that_a_fit_left_to_chance_decide_nothing() -> None:
    counts = np.random.default_rng(1).normal(0.0, 0.7, (5000, 2))
    first = np.diff(counts, axis=0)
    # Next to nothing beside the noise of a sample, but it adds up, and counts do not.
    second = first + 0.02 * np.sin(np.arange(len(first)) / 500.0)[:, None]
    assert np.all(falls_beyond_past(first, second) < -30.0)
    assert delta_bic_beyond_past(leaving(first), leaving(second)) > -INDISTINGUISHABLE
