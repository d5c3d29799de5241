"""Effects that hide each other, to first order: what is needed beside what."""

from fits import fitted
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.identification.selection.hidden import hidden
from diffbot_sim.identification.selection.screening import Screen
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects import Effect
from diffbot_sim.physics.effects.actuator_gain import ActuatorGain
from diffbot_sim.physics.effects.quadratic_drag import QuadraticDrag
from diffbot_sim.physics.effects.wheel_friction_asymmetry import WheelFrictionAsymmetry

KINDS = [ActuatorGain, WheelFrictionAsymmetry, QuadraticDrag]


def hidden_in(*effects: Effect) -> list[type[Effect]]:
    """Return what may be hidden in a noisy drive of a robot with these effects."""
    drive = random_forces(4, 60.0, -9.0, 11.0)
    fit, _ = fitted(rehearse(Model(effects=effects), drive, Surroundings(0.015, 0.03), 4))
    return hidden(Screen(fit), KINDS)


def test_nothing_is_hidden_where_nothing_is_missing() -> None:
    assert hidden_in() == []


def test_one_of_two_that_undo_each_other_may_be_hidden() -> None:
    found = hidden_in(ActuatorGain(0.008), WheelFrictionAsymmetry(0.012, 0.012))
    assert found == [WheelFrictionAsymmetry]


def test_what_needs_no_other_is_not_hidden() -> None:
    assert hidden_in(QuadraticDrag(0.5)) == []
