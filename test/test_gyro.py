"""A robot that stands, and a gyro that says it turns."""

from dataclasses import replace

import numpy as np
import pytest
from peer_recording import reckoned
from rehearsal import Surroundings, rehearse

from diffbot_sim.identification.recordings.gyro import bias_of, unbiased
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects import Effect
from diffbot_sim.physics.effects.force_bias import ForceBias
from diffbot_sim.records import Commands, Run
from diffbot_sim.standing import NOTHING, turning


def drive(bias: float = 0.0, *effects: Effect) -> Run:
    """Stand for 3 s, then drive for 3 s."""
    time = np.arange(600) * 0.01
    force = np.outer(time >= 3.0, [6.0, 5.0])
    run = rehearse(Model(effects=effects), Commands(time, force), Surroundings(), 2)
    twist = run.odometry.twist + np.array([0.0, bias])
    return replace(run, odometry=replace(run.odometry, twist=twist))


@pytest.mark.parametrize('bias', [-0.03, 0.01])
def test_bias_of_a_gyro_shows_while_the_robot_stands(bias: float) -> None:
    assert turning(drive(bias=bias)).rate == pytest.approx(bias, abs=2e-3)


def test_good_odometry_of_a_standing_robot_is_silent() -> None:
    assert not turning(drive()).is_told


def test_robot_that_really_moves_without_a_command_has_no_bias() -> None:
    assert turning(drive(0.0, ForceBias(3.0, -3.0))) == NOTHING


def test_robot_that_turns_ever_faster_without_a_command_has_no_bias() -> None:
    run = drive()
    twist = run.odometry.twist + np.outer(run.odometry.time, [0.0, -0.012])
    assert turning(replace(run, odometry=replace(run.odometry, twist=twist))) == NOTHING


def test_drive_without_a_rest_tells_nothing() -> None:
    run = drive(bias=0.03)
    pushed = replace(run.commands, force=np.ones_like(run.commands.force))
    assert turning(replace(run, commands=pushed)) == NOTHING


def dead_reckoned(run: Run) -> Run:
    """Return a run whose pose was made of its twist."""
    seen = run.odometry
    return replace(run, odometry=replace(seen, pose=reckoned(seen.time, seen.twist)))


def test_wheels_that_count_nothing_tell_it_under_force_too() -> None:
    run = drive(bias=0.01)
    counted = run.odometry.twist.copy()
    counted[: len(counted) // 2, 0] = 0.0
    pushed = replace(run.commands, force=run.commands.force + 0.1)
    run = Run('counted', pushed, replace(run.odometry, twist=counted))
    assert turning(run).rate == pytest.approx(0.01, abs=2e-3)


def test_turning_on_the_spot_is_no_bias() -> None:
    run = drive()
    spun = np.column_stack([np.zeros(len(run.odometry.time)), run.odometry.twist[:, 1] + 0.5])
    pushed = replace(run.commands, force=np.ones_like(run.commands.force))
    assert turning(Run('spun', pushed, replace(run.odometry, twist=spun))) == NOTHING


def test_good_odometry_is_taken_as_it_is() -> None:
    time = np.arange(500) * 0.02
    run = rehearse(Model(), Commands(time, np.outer(time >= 3.0, [6.0, 5.0])), Surroundings(), 3)
    assert unbiased(run) is run
    assert bias_of(run, unbiased(run)) is None


@pytest.mark.parametrize('bias', [-0.03, 0.01])
def test_bias_is_taken_off_turn_rates_and_told(bias: float) -> None:
    run = drive(bias)
    taken = unbiased(run)
    assert taken.odometry.twist == pytest.approx(drive().odometry.twist, abs=2e-3)
    assert bias_of(run, taken).rate == pytest.approx(bias, abs=2e-3)


def test_pose_that_was_made_of_biased_rates_is_made_of_unbiased_ones() -> None:
    taken = unbiased(dead_reckoned(drive(bias=0.03))).odometry
    assert taken.pose == pytest.approx(dead_reckoned(drive()).odometry.pose, abs=0.01)


def test_pose_that_knows_better_is_left_alone() -> None:
    run = drive(bias=0.03)
    assert unbiased(run).odometry.pose is run.odometry.pose
