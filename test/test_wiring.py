"""Recordings that are wired otherwise than they say: sides, signs, units, clocks."""

import re
from dataclasses import replace

import numpy as np
import pytest
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.identification import identify
from diffbot_sim.identification.fitting.coordinates import Space
from diffbot_sim.identification.fitting.wiring import fault_of
from diffbot_sim.identification.recordings.recordings import Recordings
from diffbot_sim.physics import Friction, Model, Robot
from diffbot_sim.physics.effects import library
from diffbot_sim.records import Run

DECLARED = Model(
    Robot(mass=11.0, inertia=0.35), Friction(mu_coulomb=0.035, mu_static=0.045, mu_viscous=0.07)
)


def drive(model: Model | None = None, roughness: float = 0.3) -> Run:
    forces = random_forces(3, 60.0, -9.0, 11.0)
    return rehearse(model or Model(), forces, Surroundings(roughness=roughness), 3)


def told_of(run: Run) -> str:
    fault = fault_of(Recordings((run,), ()), Space(DECLARED, ()))
    return '' if fault is None else fault.words


def with_forces(run: Run, right: float, left: float) -> Run:
    force = run.commands.force * [right, left]
    return replace(run, commands=replace(run.commands, force=force))


def with_twist(run: Run, v: float, omega: float) -> Run:
    twist = run.odometry.twist * [v, omega]
    return replace(run, odometry=replace(run.odometry, twist=twist, pose=None))


def exchanged(run: Run) -> Run:
    return replace(run, commands=replace(run.commands, force=run.commands.force[:, ::-1]))


def by_another_clock(run: Run, late: float) -> Run:
    return replace(run, commands=replace(run.commands, time=run.commands.time - late))


@pytest.mark.parametrize(
    ('run', 'words'),
    [
        (exchanged(drive()), 'left and right were exchanged'),
        (with_twist(drive(), 1.0, -1.0), 'or the turn rate had the other sign'),
        (with_twist(drive(), -1.0, 1.0), 'the speed had the other sign'),
        (with_forces(drive(), -1.0, -1.0), 'both forces had the other sign'),
        (with_forces(drive(), -1.0, 1.0), 'the force of the right wheel had the other sign'),
        (with_forces(drive(), 1.0, -1.0), 'the force of the left wheel had the other sign'),
        (with_forces(drive(), 1e3, 1e3), 'the forces were told in mN'),
        (with_forces(drive(), 1e-3, 1e-3), 'the forces were told in kN'),
        (with_twist(drive(), 1000.0, 1.0), 'the speed was told in mm/s'),
        (with_twist(drive(), 1.0, 180.0 / np.pi), 'the turn rate was told in degrees'),
        (
            by_another_clock(drive(), 3.0),
            'the odometry was stamped about (2.9|3.0) s later',
        ),
        (
            by_another_clock(drive(), -7.0),
            'the odometry was stamped about (6.9|7.0|7.1) s earlier',
        ),
    ],
)
def test_fault_is_told_from_the_motion(run: Run, words: str) -> None:
    assert re.search(words, told_of(run))


@pytest.mark.parametrize('name', ['slope', 'quadratic_drag', 'actuator_lag', 'actuator_gain'])
def test_effect_is_no_fault_however_strong(name: str) -> None:
    kind = library()[name]
    strong = kind(**{s.name: s.default + 10.0 * s.scale for s in kind.specs()})
    assert told_of(drive(Model().with_effect(strong))) == ''


def test_robot_that_hardly_moves_as_it_is_driven_is_not_guessed_at() -> None:
    rng = np.random.default_rng(4)
    still = replace(drive().odometry, twist=rng.normal(0.0, 0.3, drive().odometry.twist.shape))
    assert told_of(replace(drive(), odometry=still)) == ''


@pytest.mark.parametrize('factor', [0.1, 3.0])
def test_forces_in_another_unit_are_taken_up_by_what_is_fitted(factor: float) -> None:
    assert told_of(with_forces(drive(), factor, factor)) == ''


def test_one_run_by_another_clock_is_told_by_its_name() -> None:
    late = replace(by_another_clock(drive(), 3.0), name='late')
    fault = fault_of(Recordings((drive(), late), ()), Space(DECLARED, ()))
    assert fault is not None
    assert re.match('the odometry of late was stamped about (2.9|3.0) s later', fault.words)


def test_unit_of_the_speed_is_told_where_a_heavier_robot_would_move_alike() -> None:
    coulomb = Model(friction=Friction('coulomb'))
    run = with_twist(drive(coulomb, roughness=0.0), 1000.0, 1.0)
    answer = identify([run], coulomb)
    assert answer.unexplained is not None
    assert 'the speed was told in mm/s' in answer.unexplained.description


def test_fault_is_the_answer_and_no_effect_is_named() -> None:
    answer = identify([exchanged(drive(roughness=0.0))], DECLARED)
    assert answer.verdict == 'unexplained'
    assert answer.unexplained is not None
    assert answer.unexplained.description.startswith('the robot moves as if left and right were')
    assert answer.effects == answer.candidates == answer.advice == ()
