"""One run of another condition among several: what it takes to learn from the others alone."""

from dataclasses import replace
from itertools import count

import numpy as np
import pytest
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.identification import Identification, identify
from diffbot_sim.physics import Friction, Model, Robot
from diffbot_sim.physics.effects import Effect
from diffbot_sim.physics.effects.actuator_gain import ActuatorGain
from diffbot_sim.physics.effects.quadratic_drag import QuadraticDrag
from diffbot_sim.physics.effects.slope import Slope
from diffbot_sim.physics.effects.yaw_friction import YawFriction
from diffbot_sim.records import Run

PLAIN = Model()
LOADED = Model(
    Robot(mass=13.0, inertia=0.5), Friction(mu_static=0.06, mu_coulomb=0.04, mu_viscous=0.1)
)
KINDS: tuple[type[Effect], ...] = (ActuatorGain, QuadraticDrag, Slope)


def drive(robot: Model, number: int) -> Run:
    """Return a drive of random forces on a smooth floor."""
    forces = random_forces(number, 40.0, -9.0, 11.0)
    return replace(rehearse(robot, forces, Surroundings(), number), name=f'run {number}')


def straight(robot: Model, number: int) -> Run:
    """Return a drive in which both wheels are driven alike."""
    forces = random_forces(number, 40.0, -9.0, 11.0)
    alike = replace(forces, force=np.repeat(forces.force[:, :1], 2, axis=1))
    return replace(rehearse(robot, alike, Surroundings(), number), name=f'run {number}')


def answer(*robots: Model) -> Identification:
    """Identify one drive of each robot."""
    return identify([drive(*it) for it in zip(robots, count())], PLAIN, kinds=KINDS)


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


@pytest.mark.parametrize('acts', [QuadraticDrag(6.0), Slope(0.025, 0.01)], ids=lambda it: it.name)
def test_effect_that_acts_in_one_run_and_that_the_others_deny_is_told_of_that_run(
    acts: Effect,
) -> None:
    found = answer(PLAIN, Model(effects=(acts,)), PLAIN)
    assert found.verdict == 'nothing_missing'
    assert [run.own_effects for run in found.runs] == [(), (acts.name,), ()]


def test_effect_that_the_other_runs_do_not_show_is_told_of_all() -> None:
    scrubbing = Model(effects=(YawFriction(0.3, 0.3),))
    runs = [straight(scrubbing, 0), drive(scrubbing, 1), straight(scrubbing, 2)]
    found = identify(runs, PLAIN, kinds=(YawFriction,))
    assert [effect.name for effect in found.effects] == ['yaw_friction']
    assert not any(run.set_aside for run in found.runs)


def test_of_two_runs_none_is_set_aside() -> None:
    found = answer(PLAIN, LOADED)
    assert [(run.agrees, run.set_aside) for run in found.runs] == [(False, False)] * 2
