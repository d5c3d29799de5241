"""Whether twists are older than their stamps, or the robot is late."""

import pytest

from diffbot_sim.identification.fitting.coordinates import Space
from diffbot_sim.identification.fitting.fit import FIRST_GAINS, UNIT, Fit
from diffbot_sim.identification.older import Older, is_taken
from diffbot_sim.identification.recordings.lateness import TWIST, of_interval_before
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects.actuator_delay import ActuatorDelay


def fit_of(*kinds: type) -> Fit:
    space = Space(Model(), kinds)
    return Fit(space, (), space.prior() + 0.5, FIRST_GAINS, UNIT)


def means_are_taken(worth: float, unexplained: float = 0.0) -> bool:
    """Say whether means are taken, beside a late robot that explains more or less than they do."""
    means = Older('twists', TWIST, of_interval_before, lambda first, second: worth)
    return is_taken(means, fit_of(ActuatorDelay), fit_of(), unexplained)


@pytest.mark.parametrize(('worth', 'taken'), [(30.0, True), (-5.0, True), (-30.0, False)])
def test_means_are_taken_where_they_explain_as_much_as_a_late_robot(worth, taken):
    assert means_are_taken(worth) == taken


@pytest.mark.parametrize(('worth', 'taken'), [(-30.0, True), (-60.0, False)])
def test_beside_a_force_without_a_name_they_may_explain_a_little_less(worth, taken):
    assert means_are_taken(worth, unexplained=800.0) == taken
