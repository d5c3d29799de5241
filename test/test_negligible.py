"""What changes the motion by next to nothing is neither named nor told."""

import pytest
from fits import SMOOTH, fitted, left_by
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.identification import identify
from diffbot_sim.identification.fitting.fit import whitened
from diffbot_sim.identification.fitting.negligible import simulates_alike
from diffbot_sim.identification.fitting.predictor import NO_GAIN
from diffbot_sim.identification.selection.trials import SLIGHT
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects.quadratic_drag import QuadraticDrag
from diffbot_sim.records import Run

QUIET = Surroundings(v_noise=2e-4, omega_noise=5e-4)


def driven_with_drag(coefficient: float, around: Surroundings = SMOOTH) -> Run:
    model = Model().with_effect(QuadraticDrag(coefficient))
    return rehearse(model, random_forces(3, 60.0, -9.0, 11.0), around, 3)


@pytest.mark.parametrize(('coefficient', 'slight'), [(0.02, True), (0.5, False)])
def test_difference_is_negligible_beside_motion_and_noise(
    coefficient: float, slight: bool
) -> None:
    fit, _ = fitted(driven_with_drag(0.0))
    dragged = fit.model.with_effect(QuadraticDrag(coefficient))
    errors = whitened(fit.stretches, dragged, NO_GAIN, fit.sigma)
    assert simulates_alike(fit, errors) == slight


def test_effect_beyond_chance_that_hardly_changes_the_motion_is_not_named() -> None:
    result = identify([driven_with_drag(0.03)], Model(), kinds=[QuadraticDrag])
    assert result.verdict == 'nothing_missing'
    (drag,) = result.candidates
    assert drag.outcome == SLIGHT
    assert drag.score > 30.0


def test_effect_that_a_quiet_odometry_shows_is_named_however_slight() -> None:
    result = identify([driven_with_drag(0.03, QUIET)], Model(), kinds=[QuadraticDrag])
    assert [effect.name for effect in result.effects] == ['quadratic_drag']


def test_force_that_hardly_changes_the_motion_is_not_told() -> None:
    assert left_by(driven_with_drag(0.035)) == []
    assert left_by(driven_with_drag(0.5)) != []
