"""Doubt about an answer, names and silence alike."""

from dataclasses import replace
from functools import cache
from math import inf, nan

import numpy as np
import pytest
from fits import SURE, acted_otherwise
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.identification import identify
from diffbot_sim.identification.doubt import Seen, doubt
from diffbot_sim.identification.fitting.coordinates import Space
from diffbot_sim.identification.fitting.fit import FIRST_GAINS, Fit, fit_prediction
from diffbot_sim.identification.free_forms.bases import bases
from diffbot_sim.identification.recordings.stretches import Stretch, split
from diffbot_sim.identification.selection.evidence import Evidence
from diffbot_sim.identification.selection.stepwise import Selection
from diffbot_sim.identification.selection.trials import (
    CHANCE,
    OUTDONE,
    SUPPORTED,
    UNCONFIRMED,
    Trial,
)
from diffbot_sim.identification.statistics.guards import (
    BEYOND_ALL,
    FAR_BEYOND,
    lasting,
    least_worth,
)
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects import Effect
from diffbot_sim.physics.effects.quadratic_drag import QuadraticDrag


@cache
def fitted(*effects: Effect) -> tuple[Fit, tuple[Stretch, ...]]:
    """Return a fit that has the effects of its robot, and held-out data."""
    run = rehearse(Model(effects=effects), random_forces(1, 40.0, -9.0, 11.0), Surroundings(), 1)
    learned, held_out = split([run])
    space = Space(Model(), tuple(type(effect) for effect in effects))
    return fit_prediction(space, learned, space.prior(), FIRST_GAINS), held_out


EXPLAINING = QuadraticDrag(coefficient=6.0)


def answer_after(
    outcome: str, delta_bic: float, held: float = 0.2, folds: float = 0.2, tried: Fit | None = None
):
    """Return what doubt says of silence when this is how an effect fared that did not enter."""
    fit, held_out = fitted()
    evidence = Evidence(delta_bic, 0.0, 0.05, 0.1, held, folds)
    trial = Trial(QuadraticDrag, tried or fitted(EXPLAINING)[0], evidence, outcome)
    return doubt(Seen(Selection(fit, fit, (trial,), {}, {}, {}), held_out))


def test_noise_has_no_rhythm_that_is_worth_a_try() -> None:
    fit, _ = fitted()
    variables = {basis.variable for basis in bases(fit, fit.stretches)}
    assert 'time' in variables
    assert not variables & {'rhythm', 'wheel_angle'}


def test_refused_effect_that_explains_too_much_for_chance_is_no_silence() -> None:
    selection, left, _ = answer_after(UNCONFIRMED, 90.0)
    assert selection.final.space.kinds == ()
    assert left is not None
    assert left.description.startswith('something that quadratic_drag explains in part')


def test_what_the_model_explains_as_well_alone_raises_no_suspicion() -> None:
    space = Space(Model(), (QuadraticDrag,))
    needless = replace(fitted()[0], space=space, u=space.prior())
    assert answer_after(UNCONFIRMED, 90.0, tried=needless).unexplained is None


def test_name_that_explains_nothing_as_it_is_looked_at_is_withdrawn() -> None:
    fit, held_out = fitted()
    space = Space(Model(), (QuadraticDrag,))
    needless = replace(fit, space=space, u=space.prior())
    name = QuadraticDrag.name
    selection = Selection(fit, needless, (), {name: fit}, {name: SURE}, {name: ()})
    doubted = doubt(Seen(selection, held_out))
    assert (doubted.selection.final, doubted.unexplained) == (fit, None)


@pytest.mark.parametrize('folds', [0.8, nan])  # of a law of time parts prove nothing
def test_what_all_other_data_speak_against_raises_no_suspicion(folds: float) -> None:
    assert answer_after(UNCONFIRMED, 90.0, held=0.8, folds=folds).unexplained is None


@pytest.mark.parametrize(
    ('outcome', 'delta_bic'), [(CHANCE, 20.0), (SUPPORTED, 90.0), (OUTDONE, 90.0)]
)
def test_what_chance_can_do_and_what_is_told_already_raise_no_suspicion(
    outcome, delta_bic
) -> None:
    assert answer_after(outcome, delta_bic).unexplained is None


@pytest.mark.parametrize(
    ('p_block', 'elsewhere', 'lasts'),
    [(0.009, 0.04, True), (0.012, 1e-5, True), (0.0, 0.04, True), (0.02, 0.04, False)],
)
def test_doubt_on_one_side_asks_for_certainty_on_the_other(
    p_block: float, elsewhere: float, lasts: bool
) -> None:
    assert lasting(p_block, elsewhere) is lasts


def test_what_no_other_data_show_is_passing_however_sure_it_seems() -> None:
    assert not lasting(1e-12, 0.06)


def test_where_blocks_cannot_tell_other_data_must_be_as_sure_as_both_would_be() -> None:
    assert lasting(nan, 1e-3)
    assert not lasting(nan, 0.01)


@pytest.mark.parametrize(
    ('p_block', 'p_folds', 'p_held_out', 'asked'),
    [
        pytest.param(1e-4, 0.01, 0.01, 0.0, id='foreseen_everywhere'),
        pytest.param(1e-4, 0.01, 1.0, FAR_BEYOND, id='ended_since'),
        pytest.param(2e-5, 0.09, 0.28, BEYOND_ALL, id='foreseen_by_none_denied_by_none'),
        pytest.param(2e-5, 0.6, 0.5, inf, id='denied'),
        pytest.param(0.02, 0.09, 0.28, inf, id='passing'),
        pytest.param(nan, 0.2, 0.2, inf, id='in_too_few_blocks'),
    ],
)
def test_the_less_other_data_foresee_a_force_the_more_it_must_be_worth(
    p_block: float, p_folds: float, p_held_out: float, asked: float
) -> None:
    assert least_worth(p_block, p_folds, p_held_out) == asked


def test_limit_with_a_soft_corner_is_named_beside_what_its_corner_leaves() -> None:
    commands, limit = random_forces(3, 60.0, -9.0, 11.0), 6.0
    softly = commands.force / (1.0 + np.abs(commands.force / limit) ** 10) ** 0.1
    result = identify([acted_otherwise(commands, softly)], Model())
    assert [effect.name for effect in result.effects] == ['actuator_saturation']
    assert 'wheel' in result.unexplained.description
