"""Structure that no effect accounts for, found in what a fit leaves."""

from diffbot_sim.control.rehearsal import Surroundings, random_forces, rehearse
from diffbot_sim.identification.coordinates import Space
from diffbot_sim.identification.dependence import Dependence
from diffbot_sim.identification.fitting import FIRST_GAINS, fit_prediction
from diffbot_sim.identification.screening import Screen
from diffbot_sim.identification.stretches import split
from diffbot_sim.identification.structure import find_dependences
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects.actuator_gain import ActuatorGain

ROUGH = Surroundings(roughness=0.3)


def left_by(truth: Model, seed: int) -> list[Dependence]:
    """Return what a fit of the plain model leaves of a minute on a rough floor."""
    run = rehearse(truth, random_forces(seed, 60.0, -9.0, 11.0), ROUGH, seed)
    fitted, held_out = split([run])
    space = Space(Model(), ())
    fit = fit_prediction(space, fitted, space.prior(), FIRST_GAINS)
    return find_dependences(Screen(fit), held_out)


def test_rough_floor_alone_leaves_nothing_to_be_told() -> None:
    assert left_by(Model(), 4) == []


def test_weak_force_in_proportion_to_something_is_told_as_a_line() -> None:
    left, *_ = left_by(Model().with_effect(ActuatorGain(imbalance=0.03)), 3)
    assert (left.basis.variable, left.basis.axis) == ('wheel_force', 'difference')
    assert left.basis.size == 2
