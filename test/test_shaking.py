"""Fits shaken out of local minima."""

from dataclasses import replace

import numpy as np
import pytest
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.identification.fitting.coordinates import Space, point_of
from diffbot_sim.identification.fitting.fit import FIRST_GAINS, Fit, fit_prediction
from diffbot_sim.identification.fitting.shaking import shaken
from diffbot_sim.identification.recordings.stretches import split
from diffbot_sim.physics import Friction, Model
from diffbot_sim.physics.effects.payload_change import PayloadChange

STATIC = 0.0616


@pytest.fixture(scope='module')
def from_either_side() -> list[Fit]:
    """Fit a robot that starts hard, from static friction that is taken for too low or too high."""
    model = replace(Model(), friction=replace(Friction(), mu_static=STATIC))
    run = rehearse(model, random_forces(2, 60.0, -4.0, 6.0), Surroundings(), 2)
    learned, _ = split([run])
    space = Space(Model(), ())
    index = [coordinate.name for coordinate in space.coordinates].index('mu_static')
    starts = [space.prior() + np.eye(6)[index] * beside for beside in (0.2, 1.2)]
    return [fit_prediction(space, learned, start, FIRST_GAINS) for start in starts]


def test_fits_from_either_side_agree_once_shaken(from_either_side: list[Fit]) -> None:
    low, high = (shaken(fit) for fit in from_either_side)
    assert all(
        fit.deviance(low.sigma) > low.deviance(low.sigma) + 10.0 for fit in from_either_side
    )
    assert high.deviance(low.sigma) == pytest.approx(low.deviance(low.sigma), abs=1.0)


def test_fit_in_the_lowest_minimum_stays_there(from_either_side: list[Fit]) -> None:
    lowest = shaken(from_either_side[0])
    assert shaken(lowest) is lowest


@pytest.mark.parametrize('seed', [3, 6])
def test_a_moment_comes_out_of_the_hollows_beside_it(seed: int) -> None:
    load, late = (PayloadChange(6.0, 0.2, moment) for moment in (25.3, 27.3))
    loaded, around = Model(effects=(load,)), Surroundings(roughness=0.6)
    run = rehearse(loaded, random_forces(seed, 60.0, -6.0, 9.0), around, seed)
    learned, _ = split([run])
    space = Space(Model(), (PayloadChange,))
    start = np.append(Space(Model(), ()).prior(), point_of(PayloadChange, late.values))
    (found,) = shaken(fit_prediction(space, learned, start, FIRST_GAINS)).model.effects
    assert found.values[2] == pytest.approx(25.3, abs=0.2)
