"""Effects that hide each other, to first order: what is needed beside what."""

from dataclasses import replace

from fits import fitted
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.identification.selection.hidden import hidden
from diffbot_sim.identification.selection.screening import Screen
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects import Effect
from diffbot_sim.physics.effects.actuator_gain import ActuatorGain
from diffbot_sim.physics.effects.quadratic_drag import QuadraticDrag
from diffbot_sim.physics.effects.slope import Slope
from diffbot_sim.physics.effects.wheel_friction_asymmetry import WheelFrictionAsymmetry
from diffbot_sim.records import Commands

NOISY = Surroundings(0.015, 0.03)
KINDS = [ActuatorGain, WheelFrictionAsymmetry, QuadraticDrag, Slope]
DRIVE = random_forces(4, 60.0, -9.0, 11.0)


def hidden_in(
    *effects: Effect, drive: Commands = DRIVE, around: Surroundings = NOISY
) -> list[type[Effect]]:
    """Return what may be hidden in a drive of a robot with these effects."""
    fit, _ = fitted(rehearse(Model(effects=effects), drive, around, 4))
    return [near.space.kinds[-1] for near in hidden(Screen(fit), KINDS)]


def test_nothing_is_hidden_where_nothing_is_missing() -> None:
    assert hidden_in() == []


def test_one_of_two_that_undo_each_other_may_be_hidden() -> None:
    found = hidden_in(ActuatorGain(0.008), WheelFrictionAsymmetry(0.012, 0.012))
    assert found == [WheelFrictionAsymmetry]


def test_what_needs_no_other_is_not_hidden() -> None:
    assert hidden_in(QuadraticDrag(0.5)) == []


def test_what_shows_in_turns_alone_hides_nothing_in_a_robot_that_never_turns() -> None:
    straight = replace(DRIVE, force=DRIVE.force.mean(axis=1, keepdims=True).repeat(2, axis=1))
    assert hidden_in(drive=straight, around=Surroundings(omega_noise=0.0)) == []
