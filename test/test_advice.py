"""Advice: which drive would show what this one does not."""

from diffbot_sim.identification.conclusions.advice import advice
from diffbot_sim.identification.result import Estimate
from diffbot_sim.identification.selection.evidence import Evidence
from diffbot_sim.identification.selection.stepwise import Selection
from diffbot_sim.identification.selection.trials import CHANCE, SUPPORTED, UNSEEN, Trial
from diffbot_sim.physics.effects.slope import Slope
from diffbot_sim.physics.effects.yaw_friction import YawFriction

SHARP = Estimate(10.0, 9.9, 10.1, 'kg')
VAGUE = Estimate(10.0, 4.0, 16.0, 'kg')


def selection(*trials: Trial) -> Selection:
    return Selection(None, None, trials, {}, {}, {})


def tried(kind, outcome: str) -> Trial:
    return Trial(kind, None, Evidence(0.0, 1.0, 1.0, 0.0, 1.0, 1.0), outcome)


def test_effect_that_the_drive_does_not_show_asks_for_a_drive() -> None:
    found = advice(selection(tried(YawFriction, UNSEEN), tried(Slope, CHANCE)), {'mass': SHARP})
    assert found == (
        f'yaw_friction cannot be seen in this drive; it would take {YawFriction.excitation}.',
    )


def test_parameter_of_a_wide_interval_asks_for_a_drive() -> None:
    (line,) = advice(selection(), {'mass': VAGUE, 'inertia': SHARP})
    assert line.startswith('mass is known to ±60% only; it would take hard acceleration')


def test_vague_parameter_of_an_effect_asks_for_the_drive_of_that_effect() -> None:
    (line,) = advice(selection(tried(Slope, SUPPORTED)), {'slope.grade_x': VAGUE})
    assert Slope.excitation in line


def test_parameter_at_its_bound_is_open() -> None:
    (line,) = advice(selection(), {'mu_viscous': Estimate(0.0, 0.0, 0.0, 's/m', at_bound=True)})
    assert 'at the end of its valid range' in line


def test_mass_that_was_declared_far_off_is_to_be_declared_nearer() -> None:
    (line,) = advice(selection(), {'mass': Estimate(33.3, 33.2, 33.4, 'kg', at_bound=True)})
    assert '30 times larger or smaller than declared' in line
    assert 'declare it nearer' in line
