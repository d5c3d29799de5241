"""Declared effects that are not there, or of another size."""

from dataclasses import replace
from functools import cache

import pytest
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.identification import identify
from diffbot_sim.identification.result import Identification
from diffbot_sim.physics import Friction, Model
from diffbot_sim.physics.effects import Effect
from diffbot_sim.physics.effects.actuator_lag import ActuatorLag
from diffbot_sim.physics.effects.quadratic_drag import QuadraticDrag
from diffbot_sim.physics.effects.slope import Slope
from diffbot_sim.physics.effects.yaw_friction import YawFriction
from diffbot_sim.records import Run

NEAR = (Slope, QuadraticDrag, ActuatorLag, YawFriction)  # kinds that are asked about


def drive(effects: tuple[Effect, ...], robot: Model | None = None) -> Run:
    """Return a drive of our own robot, or another, with some effects."""
    forces = random_forces(5, 35.0, -9.0, 11.0)
    return rehearse(replace(robot or Model(), effects=effects), forces, Surroundings(), 5)


@cache
def answer(true: tuple[Effect, ...], declared: tuple[Effect, ...]) -> Identification:
    """Return what is told of our own robot with some effects, declared with others."""
    return identify([drive(true)], Model(effects=declared), kinds=NEAR)


def named(told: Identification) -> list[str]:
    return [effect.name for effect in told.effects]


@pytest.mark.parametrize('effect', [Slope(0.02, 0.0), ActuatorLag(0.2), YawFriction(0.5, 0.0)])
def test_declared_effect_that_is_not_there_is_contradicted(effect: Effect) -> None:
    told = answer((), (effect,))
    assert (told.verdict, told.contradicted) == ('nothing_missing', (effect.name,))
    assert told.recalibrated.effects == told.identified.effects == ()


@pytest.mark.parametrize('effect', [Slope(0.02, 0.0), ActuatorLag(0.2), QuadraticDrag(6.0)])
def test_declared_effect_that_is_there_is_believed(effect: Effect) -> None:
    told = answer((effect,), (effect,))
    assert (told.verdict, told.contradicted) == ('nothing_missing', ())
    assert told.recalibrated.effects == (effect,)


def test_declared_effect_is_believed_beside_one_that_is_missing() -> None:
    told = answer((Slope(0.02, 0.0), QuadraticDrag(6.0)), (Slope(0.02, 0.0),))
    assert (named(told), told.contradicted) == (['quadratic_drag'], ())


def test_missing_effect_is_found_beside_a_declared_one_that_is_not_there() -> None:
    told = answer((QuadraticDrag(6.0),), (Slope(0.02, 0.0),))
    assert (named(told), told.contradicted) == (['quadratic_drag'], ('slope',))
    assert told.unexplained is None


@pytest.mark.parametrize('law', ['none', 'coulomb', 'coulomb_viscous'])
def test_too_simple_a_law_of_friction_is_contradicted(law: str) -> None:
    declared = Model(friction=Friction(model=law))
    told = identify([drive(())], declared, kinds=NEAR)
    assert (told.verdict, told.contradicted) == ('nothing_missing', ('friction.model',))
    assert told.identified.friction.model == 'generalized'
    assert told.near_rest == 0.0


def test_simple_law_of_friction_is_believed_beside_what_is_missing() -> None:
    simple = Model(friction=Friction(model='coulomb_viscous'))
    told = identify([drive((QuadraticDrag(6.0),), simple)], simple, kinds=NEAR)
    assert (named(told), told.contradicted) == (['quadratic_drag'], ())


def test_effect_of_about_the_declared_size_is_recalibrated() -> None:
    told = answer((QuadraticDrag(6.0),), (QuadraticDrag(4.0),))
    assert (told.verdict, told.contradicted) == ('nothing_missing', ())
    (drag,) = told.recalibrated.effects
    assert drag.values == pytest.approx((6.0,), rel=0.05)


def test_effect_of_the_other_sign_is_found_anew() -> None:
    told = answer((Slope(0.02, 0.0),), (Slope(-0.02, 0.0),))
    assert (named(told), told.contradicted) == (['slope'], ('slope',))
    assert told.effects[0].parameters['grade_x'].value == pytest.approx(0.02, rel=0.05)
