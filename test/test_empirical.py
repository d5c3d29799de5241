"""Tables of what is left without a name, beside those of an earlier round."""

import pytest

from diffbot_sim.identification.conclusions.empirical import _added
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects.empirical_force import POINTS, EmpiricalForce


def level(force: float, low: float, high: float, variable: str = 'v') -> EmpiricalForce:
    return EmpiricalForce('v', variable, low, high, *([force] * POINTS))


def test_table_beside_a_declared_one_holds_both() -> None:
    both = _added(level(0.25, -0.5, 2.0), Model().with_effect(level(0.5, -1.0, 1.0)))
    assert both is not None
    assert (both.low, both.high) == (-1.0, 2.0)
    assert both.points == pytest.approx([0.75] * POINTS)


def test_declared_table_over_something_else_is_kept() -> None:
    declared = Model().with_effect(level(0.5, -1.0, 1.0, 'time'))
    assert _added(level(0.25, -0.5, 2.0), declared) is None
