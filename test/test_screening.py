"""What a first look promises of an effect."""

from dataclasses import replace

import pytest

from diffbot_sim.control.rehearsal import Surroundings, random_forces, rehearse
from diffbot_sim.identification.fitting.coordinates import Space
from diffbot_sim.identification.fitting.fit import FIRST_GAINS, fit_prediction
from diffbot_sim.identification.recordings.stretches import whole
from diffbot_sim.identification.selection.screening import Screen
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects.actuator_fade import ActuatorFade


@pytest.mark.parametrize('seed', [1, 2])  # the second one has wheels that just break away
def test_first_look_promises_most_of_what_a_fit_finds_on_a_rough_floor(seed: int) -> None:
    fading = replace(Model(), effects=(ActuatorFade(rate=0.002),))
    forces = random_forces(seed, 60.0, -9.0, 11.0)
    (stretch,) = whole([rehearse(fading, forces, Surroundings(roughness=0.3), seed)])
    small, large = Space(Model(), ()), Space(Model(), (ActuatorFade,))
    without = fit_prediction(small, (stretch,), small.prior(), FIRST_GAINS)
    score = Screen(without).score(ActuatorFade)
    found = fit_prediction(large, (stretch,), score.starts[0], without.gains)
    worth = without.deviance(found.sigma) - found.deviance(found.sigma)
    assert 0.7 * worth < score.ratio < 1.3 * worth
