"""One run of another condition among several: what it takes to learn from the others alone."""

from dataclasses import replace

import pytest

from diffbot_sim.control.rehearsal import Surroundings, random_forces, rehearse
from diffbot_sim.identification import Identification, identify
from diffbot_sim.physics import Friction, Model, Robot
from diffbot_sim.physics.effects import Effect
from diffbot_sim.physics.effects.actuator_gain import ActuatorGain
from diffbot_sim.physics.effects.quadratic_drag import QuadraticDrag
from diffbot_sim.physics.effects.slope import Slope

PLAIN = Model()
LOADED = Model(
    Robot(mass=13.0, inertia=0.5), Friction(mu_static=0.06, mu_coulomb=0.04, mu_viscous=0.1)
)
KINDS: tuple[type[Effect], ...] = (ActuatorGain, QuadraticDrag, Slope)


def answer(*robots: Model) -> Identification:
    """Identify one drive of each robot, on a smooth floor."""
    runs = [
        replace(
            rehearse(robot, random_forces(i, 40.0, -9.0, 11.0), Surroundings(), i), name=f'run {i}'
        )
        for i, robot in enumerate(robots)
    ]
    return identify(runs, PLAIN, kinds=KINDS)


@pytest.fixture(scope='module')
def with_a_load() -> Identification:
    return answer(PLAIN, LOADED, PLAIN)


def test_loaded_run_is_set_aside_and_told(with_a_load: Identification) -> None:
    assert with_a_load.verdict == 'nothing_missing'
    assert [run.set_aside for run in with_a_load.runs] == [False, True, False]
    assert [run.agrees for run in with_a_load.runs] == [True, False, True]


def test_others_are_learned_from_as_if_the_loaded_run_were_not_there(
    with_a_load: Identification,
) -> None:
    assert with_a_load.nominal['mass'].low < PLAIN.robot.mass < with_a_load.nominal['mass'].high
    errors = with_a_load.errors
    assert errors.recalibrated.v_rmse < 1.1 * errors.noise_floor.v_rmse


def test_load_is_told_by_how_the_run_differs(with_a_load: Identification) -> None:
    mass = {it.name: it for it in with_a_load.runs[1].differences}['mass']
    assert mass.here.low < LOADED.robot.mass < mass.here.high


def test_run_with_an_effect_of_its_own_is_not_set_aside() -> None:
    found = answer(PLAIN, Model(effects=(Slope(0.02, 0.0),)), PLAIN)
    assert found.verdict != 'nothing_missing'
    assert not any(run.set_aside for run in found.runs)


def test_of_two_runs_none_is_set_aside() -> None:
    found = answer(PLAIN, LOADED)
    assert [(run.agrees, run.set_aside) for run in found.runs] == [(False, False)] * 2
