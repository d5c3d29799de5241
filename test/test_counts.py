"""Twists that are whole counts of encoders, and others that look like these."""

from dataclasses import replace

import numpy as np
import pytest
from counting import at_both_ends, counted, driven, posed
from fits import without_pose

from diffbot_sim.identification.recordings.counts import is_counted
from diffbot_sim.physics import Model
from diffbot_sim.records import Array, Odometry, Run


def added_up(run: Run) -> Run:
    """Return a run whose pose adds up its twists after each step."""
    return posed(run, run.odometry.twist[1:] * np.diff(run.odometry.time)[:, None])


def with_twist(run: Run, twist: Array) -> Run:
    return replace(run, odometry=replace(run.odometry, twist=twist))


def told_on(run: Run, chosen: Array | slice) -> Run:
    """Return a run of which only some samples are recorded."""
    seen = run.odometry
    kept = Odometry(seen.time[chosen], seen.twist[chosen], seen.pose[chosen])
    return replace(run, odometry=kept)


def test_differences_of_counts_are_known_as_such() -> None:
    assert is_counted(counted(driven(Model()), 1).odometry)


def test_so_they_are_where_few_messages_are_lost() -> None:
    run = counted(driven(Model()), 1)
    kept = np.random.default_rng(1).random(len(run.odometry.time)) > 0.01
    assert is_counted(told_on(run, kept).odometry)


def test_stamps_that_shake_take_nothing_from_counts_over_their_intervals() -> None:
    seen = (run := driven(Model())).odometry
    shaken = seen.time + np.random.default_rng(1).uniform(0.0, 0.01, len(seen.time))
    assert is_counted(counted(replace(run, odometry=replace(seen, time=shaken)), 1).odometry)


@pytest.mark.parametrize('unit', [0.01, 0.001])
def test_rounded_twists_are_no_counts(unit: float) -> None:
    run = driven(Model())
    twist = np.round(run.odometry.twist / unit) * unit
    assert not is_counted(added_up(with_twist(run, twist)).odometry)


def test_noisy_twists_that_a_pose_adds_up_are_no_counts() -> None:
    assert not is_counted(added_up(driven(Model())).odometry)


def test_means_over_several_intervals_are_no_counts_of_one() -> None:
    assert not is_counted(counted(driven(Model()), 5).odometry)


def test_counts_over_half_of_an_interval_are_no_counts_of_it() -> None:
    assert not is_counted(told_on(counted(driven(Model()), 1), slice(None, None, 2)).odometry)


def test_without_a_pose_that_adds_them_up_nobody_knows_over_what_they_are_counted() -> None:
    run = counted(driven(Model()), 1)
    assert not is_counted(without_pose(run).odometry)
    assert not is_counted(posed(run, at_both_ends(run.odometry)).odometry)


def test_turn_rate_of_a_gyro_is_no_count() -> None:
    run = counted(driven(Model()), 1)
    noise = np.random.default_rng(1).normal(scale=0.008, size=len(run.odometry.time))
    gyro = run.odometry.twist + np.column_stack([0.0 * noise, noise])
    assert not is_counted(with_twist(run, gyro).odometry)


@pytest.mark.parametrize('turning', [0.0, 1.0])
def test_robot_that_goes_straight_or_stands_tells_nothing_of_counts(turning: float) -> None:
    run = counted(driven(Model()), 1)
    straight = run.odometry.twist * [turning, 0.0]
    assert not is_counted(added_up(with_twist(run, straight)).odometry)
