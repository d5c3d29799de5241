"""Forces that are stamped after they acted."""

from functools import cache

import pytest
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.identification import identify
from diffbot_sim.identification.fitting.coordinates import Space
from diffbot_sim.identification.fitting.fit import FIRST_GAINS, Fit, fit_prediction
from diffbot_sim.identification.leading import lead_of
from diffbot_sim.identification.recordings.acting import acted_before
from diffbot_sim.identification.recordings.stretches import split
from diffbot_sim.identification.result import Identification
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects import Effect
from diffbot_sim.physics.effects.actuator_delay import ActuatorDelay
from diffbot_sim.physics.effects.actuator_lag import ActuatorLag
from diffbot_sim.physics.effects.slope import Slope
from diffbot_sim.records import Run


@cache
def driven(*effects: Effect) -> Run:
    """Return 40 s of random forces."""
    return rehearse(Model(effects=effects), random_forces(4, 40.0, -9.0, 11.0), Surroundings(), 4)


def fitted(run: Run) -> Fit:
    """Return the fit of the robot without effects."""
    space = Space(Model(), ())
    return fit_prediction(space, split([run])[0], space.prior(), FIRST_GAINS)


@pytest.mark.parametrize('late', [0.003, 0.02])
def test_lead_is_by_how_much_forces_are_stamped_late(late: float) -> None:
    assert lead_of(fitted(acted_before(driven(), -late))) == pytest.approx(late, abs=5e-4)


@pytest.mark.parametrize('effects', [(), (ActuatorDelay(0.03),)])
def test_forces_that_act_at_once_or_late_do_not_lead(effects: tuple[Effect, ...]) -> None:
    assert lead_of(fitted(driven(*effects))) == 0.0


def test_forces_that_are_stamped_far_too_late_lead_by_nobody_knows_how_much() -> None:
    assert lead_of(fitted(acted_before(driven(), -0.15))) == 0.0


def on_a_slope(late: float, done: list[str]) -> Identification:
    """Return what is found on a slope where forces are stamped late [s]; done: what was tried."""
    run = acted_before(driven(Slope(0.012, 0.008)), -late)
    return identify([run], Model(), progress=done.append, kinds=[Slope, ActuatorLag])


def test_forces_that_are_stamped_late_are_no_effect_and_hide_none() -> None:
    answer = on_a_slope(0.02, [])
    assert ([e.name for e in answer.effects], answer.unexplained) == (['slope'], None)
    (timing,) = answer.timings
    assert (timing.taken, timing.lateness) == ('force', pytest.approx(0.02, abs=1e-3))


def test_names_that_tell_all_are_not_searched_again_with_forces_that_act_earlier() -> None:
    answer = on_a_slope(0.002, done := [])
    assert ([e.name for e in answer.effects], answer.unexplained) == (['slope'], None)
    assert [it.taken for it in answer.timings] == ['force']
    after = done[done.index('taking forces for older than their stamps') :]
    assert not any('trying' in step for step in after)
