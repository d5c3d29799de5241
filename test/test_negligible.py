"""What changes the motion by next to nothing is neither named nor told."""

import pytest
from fits import fitted, left_by

from diffbot_sim.control.rehearsal import Surroundings, random_forces, rehearse
from diffbot_sim.identification import identify
from diffbot_sim.identification.fitting.negligible import is_negligible, simulated
from diffbot_sim.identification.selection.trials import SLIGHT
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects.quadratic_drag import QuadraticDrag
from diffbot_sim.records import Run

QUIET = Surroundings(v_noise=2e-4, omega_noise=5e-4)


def driven_with_drag(coefficient: float) -> Run:
    model = Model().with_effect(QuadraticDrag(coefficient))
    return rehearse(model, random_forces(3, 60.0, -9.0, 11.0), QUIET, 3)


@pytest.mark.parametrize(('coefficient', 'slight'), [(0.02, True), (0.5, False)])
def test_difference_is_negligible_beside_the_motion(coefficient: float, slight: bool) -> None:
    fit, _ = fitted(driven_with_drag(0.0))
    plain, dragged = (
        simulated(model, fit.stretches)
        for model in (Model(), Model().with_effect(QuadraticDrag(coefficient)))
    )
    assert is_negligible(dragged - plain, fit.stretches) == slight


def test_effect_beyond_chance_that_hardly_changes_the_motion_is_not_named() -> None:
    result = identify([driven_with_drag(0.02)], Model(), kinds=[QuadraticDrag])
    assert result.verdict == 'nothing_missing'
    (drag,) = result.candidates
    assert drag.outcome == SLIGHT
    assert drag.score > 100.0


def test_force_that_hardly_changes_the_motion_is_not_told() -> None:
    assert left_by(driven_with_drag(0.02)) == []
    assert left_by(driven_with_drag(0.5)) != []
