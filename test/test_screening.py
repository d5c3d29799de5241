"""What a first look promises of an effect."""

from dataclasses import replace

import numpy as np
import pytest
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.identification.fitting.coordinates import Space, point_of
from diffbot_sim.identification.fitting.fit import FIRST_GAINS, fit_prediction, whitened
from diffbot_sim.identification.fitting.response import responses
from diffbot_sim.identification.recordings.stretches import whole
from diffbot_sim.identification.selection.onsets import Onsets
from diffbot_sim.identification.selection.screening import Screen
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects.actuator_fade import ActuatorFade
from diffbot_sim.physics.effects.payload_change import PayloadChange


@pytest.mark.parametrize('seed', [1, 2])  # the second one has wheels that just break away
def test_first_look_promises_most_of_what_a_fit_finds_on_a_rough_floor(seed: int) -> None:
    fading = replace(Model(), effects=(ActuatorFade(rate=0.002),))
    forces = random_forces(seed, 60.0, -9.0, 11.0)
    (stretch,) = whole([rehearse(fading, forces, Surroundings(roughness=0.3), seed)])
    small, large = Space(Model(), ()), Space(Model(), (ActuatorFade,))
    without = fit_prediction(small, (stretch,), small.prior(), FIRST_GAINS)
    screen = Screen(without)
    found = fit_prediction(large, (stretch,), screen.starts(ActuatorFade)[0], without.gains)
    worth = without.deviance(found.sigma) - found.deviance(found.sigma)
    assert 0.7 * worth < screen.score(ActuatorFade).ratio < 1.3 * worth


@pytest.mark.parametrize('share', [0.0, 1.0])
@pytest.mark.parametrize('moment', [7.3, 40.0])
def test_load_at_any_moment_is_seen_to_first_order(moment: float, share: float) -> None:
    run = rehearse(Model(), random_forces(4, 60.0, 8.0, 11.0), Surroundings(), 4)
    small, large = Space(Model(), ()), Space(Model(), (PayloadChange,))
    fit = fit_prediction(small, whole([run]), small.prior(), FIRST_GAINS)
    neutral = np.concatenate([fit.u, point_of(PayloadChange, (0.0, 0.0, moment, share))])
    mass, inertia, onset, _ = large.places('payload_change')
    seen = Onsets(fit, responses(fit), 0.01).slopes(large, onset, neutral, [mass, inertia])

    def at(index: int, by: float):
        point = neutral + by * (np.arange(len(neutral)) == index)
        return whitened(fit.stretches, large.model(point), fit.gains, fit.sigma)

    for column, index in enumerate((mass, inertia)):
        wanted = (at(index, 1e-3) - at(index, -1e-3)) / 2e-3
        assert np.linalg.norm(seen[..., column] - wanted) < 0.1 * np.linalg.norm(wanted)
