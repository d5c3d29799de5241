"""Limits of force are held against one without a law: a name that only resembles it goes."""

from functools import cache

import numpy as np
import pytest
from fits import fitted
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.identification import identify
from diffbot_sim.identification.conclusions.empirical import term_in
from diffbot_sim.identification.fitting.coordinates import Space, point_of
from diffbot_sim.identification.fitting.fit import FIRST_GAINS, Fit, fit_prediction
from diffbot_sim.identification.free_forms.limit import of_another_law
from diffbot_sim.identification.result import LIMIT, Structure
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects import Effect
from diffbot_sim.physics.effects.actuator_saturation import ActuatorSaturation
from diffbot_sim.physics.effects.empirical_limit import EmpiricalLimit
from diffbot_sim.physics.effects.power_limit import PowerLimit
from diffbot_sim.physics.effects.voltage_limit import VoltageLimit
from diffbot_sim.records import Run

LAWS = (PowerLimit(6.0), VoltageLimit(12.0, 1.2), ActuatorSaturation(7.0))
# Where fits of a law begin that is not that of the robot.
BEGUN = {PowerLimit: (8.0, 8.0), VoltageLimit: (14.0, 1.5, 0.0), ActuatorSaturation: (9.0,)}


@cache
def driven(law: Effect) -> Run:
    return rehearse(Model(effects=(law,)), random_forces(4, 45.0, -12.0, 14.0), Surroundings(), 4)


@cache
def plain(law: Effect) -> Fit:
    return fitted(driven(law))[0]


def with_name(law: Effect, kind: type[Effect]) -> Fit:
    """Return the drive of a limited robot, fitted with a limit of some name."""
    rest, space = plain(law), Space(Model(), (kind,))
    values = law.values if isinstance(law, kind) else BEGUN[kind]
    start = np.append(rest.u, point_of(kind, values))
    return fit_prediction(space, rest.stretches, start, FIRST_GAINS)


def outdone(law: Effect, kind: type[Effect]) -> Structure | None:
    """Return the limit that outdoes a name, in the drive of a limited robot."""
    return of_another_law(kind, plain(law), with_name(law, kind))


@pytest.mark.parametrize('law', LAWS, ids=lambda law: law.name)
def test_no_table_outdoes_the_law_of_a_limit(law):
    assert outdone(law, type(law)) is None


@pytest.mark.parametrize(
    ('law', 'kind'),
    [(LAWS[0], VoltageLimit), (LAWS[1], PowerLimit), (LAWS[1], ActuatorSaturation)],
)
def test_a_table_outdoes_another_law(law, kind):
    left = outdone(law, kind)
    assert left is not None
    assert left.variable == LIMIT


def test_a_table_tells_the_limit_where_commands_reach_it():
    left = outdone(LAWS[1], PowerLimit)
    reached = (left.knots > 0.2) & (left.knots < 0.9)
    law = 12.0 * (1.0 - left.knots[reached] / 1.2)
    assert reached.sum() >= 2
    np.testing.assert_allclose(left.force[reached], law, atol=0.05 * 12.0)


def test_limit_of_no_known_law_is_unexplained_and_simulated_by_a_table():
    answer = identify([driven(LAWS[1])], Model(), kinds=[PowerLimit])
    assert answer.effects == ()
    assert answer.unexplained.variable == LIMIT
    assert isinstance(answer.empirical, EmpiricalLimit)
    assert term_in(answer.identified, answer.unexplained) is answer.empirical
    errors = answer.errors
    assert errors.with_effects.v_rmse < 0.5 * errors.recalibrated.v_rmse
