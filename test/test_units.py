"""Numbers of a robot that were declared in another unit, or guessed badly."""

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.errors import DataError
from diffbot_sim.identification import identify
from diffbot_sim.identification.fitting.units import within_reach
from diffbot_sim.identification.recordings.recordings import Recordings
from diffbot_sim.physics import Friction, Model, Robot
from diffbot_sim.records import Run

DECLARED = Model(
    Robot(mass=11.0, inertia=0.35), Friction(mu_coulomb=0.035, mu_static=0.045, mu_viscous=0.07)
)
RUN = rehearse(Model(), random_forces(3, 60.0, -9.0, 11.0), Surroundings(roughness=0.3), 3)


def wrong_by(factor: float, name: str) -> Model:
    wrong = {name: factor * getattr(DECLARED.robot, name)}
    return replace(DECLARED, robot=replace(DECLARED.robot, **wrong))


def set_nearer(declared: Model, run: Run = RUN) -> Model:
    fitted, _ = Recordings((run,), ()).divided
    return within_reach(declared, fitted)


@settings(max_examples=10)
@given(st.floats(0.15, 6.0), st.floats(0.15, 6.0))
def test_what_a_fit_can_reach_stays_as_declared(mass: float, inertia: float) -> None:
    declared = replace(DECLARED, robot=Robot(mass=10.0 * mass, inertia=0.4 * inertia))
    assert set_nearer(declared) == declared


@pytest.mark.parametrize('name', ['mass', 'inertia'])
@pytest.mark.parametrize('factor', [60.0, 1 / 60.0])
def test_bad_guess_is_set_nearer_to_the_runs(name: str, factor: float) -> None:
    nearer = set_nearer(wrong_by(factor, name))
    assert 0.1 < getattr(nearer.robot, name) / getattr(DECLARED.robot, name) < 10.0


@pytest.mark.parametrize(
    ('name', 'factor'),
    [(name, factor) for name in ('mass', 'inertia') for factor in (1e3, 1e-3)]
    + [('wheel_separation', factor) for factor in (100.0, 1000.0, 0.01)],
)
def test_number_in_another_unit_is_refused(name: str, factor: float) -> None:
    with pytest.raises(DataError, match=rf'robot\.{name} is declared as .* another unit\?'):
        identify([RUN], wrong_by(factor, name))


def test_nothing_is_missing_of_a_robot_that_was_guessed_badly() -> None:
    result = identify([RUN], wrong_by(0.01, 'inertia'))
    assert result.verdict == 'nothing_missing'
    assert result.nominal['inertia'].value == pytest.approx(0.4, rel=0.02)
