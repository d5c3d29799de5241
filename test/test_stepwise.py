"""The search for a structure: what enters must be needed in the end."""

import pytest
from fits import SMOOTH, fitted

from diffbot_sim.control.rehearsal import random_forces, rehearse
from diffbot_sim.identification.selection.screening import Screen
from diffbot_sim.identification.selection.stepwise import select
from diffbot_sim.identification.selection.trials import NEEDLESS, SUPPORTED, try_all
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects.quadratic_drag import QuadraticDrag


@pytest.mark.parametrize(('coefficient', 'names'), [(0.013, []), (0.025, ['quadratic_drag'])])
def test_name_is_told_only_where_the_data_can_tell_it_from_none(
    coefficient: float, names: list[str]
) -> None:
    dragging = Model(effects=(QuadraticDrag(coefficient),))
    fit, held_out = fitted(rehearse(dragging, random_forces(3, 60.0, -9.0, 11.0), SMOOTH, 3))
    (trial,) = try_all(Screen(fit), [QuadraticDrag], held_out, lambda text: None)
    assert trial.accepted
    found = select(fit, [QuadraticDrag], held_out, lambda text: None)
    assert list(found.support) == names
    assert [told.outcome for told in found.trials] == [SUPPORTED if names else NEEDLESS]
