"""Runs that agree, and runs that do not."""

from dataclasses import replace

import numpy as np
import pytest
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.identification.conclusions.agreement import Estimated as Said
from diffbot_sim.identification.conclusions.agreement import agreement, interval_chances
from diffbot_sim.identification.fitting.coordinates import Space
from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.recordings.stretches import whole
from diffbot_sim.identification.result import RunCheck
from diffbot_sim.physics import Friction, Model, Robot
from diffbot_sim.records import Run

ROBOT, HEAVY = Model(), Model(Robot(mass=12.0))
ROUGH = Surroundings(roughness=0.3)
GAINS = np.array([0.2, 0.03, 0.05, 0.3, 0.08, 0.05])


def drives(*models: Model, around: Surroundings = ROUGH) -> list[Run]:
    """Return one drive of each robot, named by its place."""
    return [
        replace(rehearse(model, random_forces(i, 40.0, -9.0, 11.0), around, i), name=f'run {i}')
        for i, model in enumerate(models)
    ]


def checked(runs: list[Run]) -> tuple[RunCheck, ...]:
    """Judge runs by a fit that is right for the first of them."""
    space = Space(ROBOT, ())
    return agreement(Fit(space, whole(runs), space.prior(), GAINS, np.array([0.0045, 0.01])), runs)


def named(checks: tuple[RunCheck, ...]) -> list[str]:
    return [check.name for check in checks if not check.agrees]


@pytest.mark.parametrize('around', [Surroundings(), ROUGH], ids=['smooth', 'rough'])
def test_runs_of_one_robot_agree(around: Surroundings) -> None:
    checks = checked(drives(ROBOT, ROBOT, ROBOT, around=around))
    assert [check.name for check in checks] == ['run 0', 'run 1', 'run 2']
    assert named(checks) == []


def test_one_run_says_nothing_of_agreement() -> None:
    assert checked(drives(ROBOT)) == ()


def test_run_with_a_payload_is_named_and_its_mass_told() -> None:
    odd = checked(drives(ROBOT, ROBOT, HEAVY, ROBOT))[2]
    difference = odd.differences[0]
    assert difference.name == 'mass'
    assert difference.here.low < 12.0 < difference.here.high
    assert difference.others.value == pytest.approx(10.0, rel=0.02)


def test_run_that_is_odd_does_not_make_the_others_look_odd() -> None:
    checks = checked(drives(ROBOT, ROBOT, HEAVY, ROBOT))
    assert named(checks) == ['run 2']
    assert checks[2].error.v_rmse > 2.0 * max(checks[i].error.v_rmse for i in (0, 1, 3))


def test_run_on_another_floor_is_named_by_its_friction() -> None:
    carpet = Model(friction=Friction(mu_coulomb=0.045, mu_static=0.06))
    checks = checked(drives(ROBOT, ROBOT, carpet))
    assert named(checks) == ['run 2']
    assert 'mu_coulomb' in [difference.name for difference in checks[2].differences]


def test_of_two_runs_that_disagree_both_are_named() -> None:
    first, second = checked(drives(ROBOT, HEAVY))
    assert named((first, second)) == ['run 0', 'run 1']
    assert first.differences[0].here == second.differences[0].others


def test_held_out_run_is_as_good_as_the_noise_where_the_others_teach_the_truth() -> None:
    for check in checked(drives(ROBOT, ROBOT, ROBOT, around=Surroundings())):
        assert check.error.v_rmse < 1.25 * check.noise_floor.v_rmse
        assert check.error.omega_rmse < 1.25 * check.noise_floor.omega_rmse


def test_difference_must_matter_and_be_beyond_chance() -> None:
    sure, vague = np.diag([1e-8]), np.diag([1.0])
    there = Said(np.array([1.0]), sure)
    assert interval_chances(Said(np.array([1.01]), sure), there) == 1.0
    assert interval_chances(Said(np.array([1.50]), vague), there) > 0.5
    assert interval_chances(Said(np.array([1.50]), sure), there) < 1e-9
