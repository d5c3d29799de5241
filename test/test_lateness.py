"""Odometry that is older than its stamps: told by its pose, or by what it makes of a robot."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from counting import at_both_ends, counted, driven, posed
from fits import fitted, without_pose

from diffbot_sim.identification import identify
from diffbot_sim.identification.older import Ages
from diffbot_sim.identification.recordings.acting import acted_before
from diffbot_sim.identification.recordings.lateness import (
    filled,
    lag_behind_pose,
    pose_denies_lag,
    timely,
    timing,
)
from diffbot_sim.identification.recordings.recordings import Recordings
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects.actuator_delay import ActuatorDelay
from diffbot_sim.physics.effects.actuator_lag import ActuatorLag
from diffbot_sim.records import Odometry, Run

LATENESS = (ActuatorDelay, ActuatorLag)


@pytest.mark.parametrize(('over', 'lag'), [(1, 0.01), (5, 0.05), (10, 0.1)])
def test_mean_lags_the_pose_by_half_of_its_length(over: int, lag: float) -> None:
    found = lag_behind_pose(counted(driven(Model()), over).odometry)
    assert found == pytest.approx(lag, abs=1e-3)


def test_twist_of_the_time_of_its_pose_is_taken_as_it_is() -> None:
    run = driven(Model())
    assert timely(run) is run
    assert timing(run, timely(run)) is None


@pytest.mark.parametrize('told', [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)])
def test_twist_that_nobody_filled_is_taken_from_the_pose(told: tuple[float, float]) -> None:
    run = driven(Model())
    bare = replace(run, odometry=replace(run.odometry, twist=run.odometry.twist * told))
    taken = filled(bare).odometry
    assert taken.means == (True, True)
    truth = np.column_stack(
        [np.interp(taken.time, run.odometry.time, x) for x in run.odometry.twist.T]
    )
    assert np.all(np.std(taken.twist - truth, axis=0) < 0.1 * np.std(truth, axis=0))


def test_twist_of_a_robot_that_stands_or_turns_on_the_spot_is_filled() -> None:
    run = driven(Model())
    pose = run.odometry.pose * [0.0, 0.0, 1.0]
    spins = replace(run.odometry, twist=run.odometry.twist * [0.0, 1.0], pose=pose)
    assert filled(replace(run, odometry=spins)).odometry is spins
    assert filled(run) is run


@pytest.mark.parametrize('seed', [1, 2, 3])
def test_noise_of_a_pose_makes_no_twist_late(seed: int) -> None:
    run = driven(Model(), seed)
    noise = np.random.default_rng(seed).normal(size=run.odometry.pose.shape) * 0.003
    noisy = replace(run, odometry=replace(run.odometry, pose=run.odometry.pose + noise))
    assert lag_behind_pose(noisy.odometry) == 0.0
    assert timely(noisy) is noisy


def test_long_mean_gives_way_to_what_the_pose_tells() -> None:
    run = counted(driven(Model()), 10)
    told = timing(run, timely(run))
    assert told.taken == 'pose'
    assert told.lateness == pytest.approx(0.1, abs=1e-3)


def test_nothing_is_told_across_a_hole() -> None:
    seen = counted(driven(Model()), 10).odometry
    rest = (seen.time < 20.0) | (seen.time > 23.0)
    holed = Odometry(seen.time[rest], seen.twist[rest], seen.pose[rest])
    taken = timely(Run('holed', driven(Model()).commands, holed)).odometry
    assert not np.any((taken.time > 20.0) & (taken.time < 23.0))


def test_of_a_noisy_pose_changes_over_more_samples_are_taken() -> None:
    run = counted(driven(Model()), 10)
    seen = run.odometry
    noise = np.random.default_rng(1).normal(size=seen.pose.shape) * 0.003
    run = replace(run, odometry=replace(seen, pose=seen.pose + noise))
    taken = timely(run)
    assert timing(run, taken).taken == 'pose'
    apart = np.diff(taken.odometry.time)
    assert np.all((apart > 0.03) & (apart < 0.11))  # longer than an interval, within the lag


def test_tracker_whose_twists_are_means_over_a_noisy_pose_makes_no_robot_strange() -> None:
    run = driven(Model())
    seen = run.odometry
    noise = np.random.default_rng(1).normal(size=seen.pose.shape) * [0.0006, 0.0006, 0.0015]
    answer = identify(
        [counted(replace(run, odometry=replace(seen, pose=seen.pose + noise)), 6)], Model()
    )
    assert answer.verdict == 'nothing_missing'


def headed_by_its_turn_rate(run: Run) -> Run:
    """Return a run whose poses have the heading that its turn rates sum up to."""
    way = run.odometry.twist[1:, 0] * np.diff(run.odometry.time)
    return posed(run, np.column_stack([way, at_both_ends(run.odometry)[:, 1]]))


def posed_by_its_twists(run: Run) -> Run:
    """Return a run whose pose tells nothing but what its twists do."""
    return posed(run, at_both_ends(run.odometry))


def test_true_pose_denies_that_twists_of_its_time_are_late() -> None:
    assert pose_denies_lag(driven(Model()), 0.01)


@pytest.mark.parametrize('known', [without_pose, posed_by_its_twists])
def test_pose_that_knows_no_more_than_twists_denies_nothing(known: Callable[[Run], Run]) -> None:
    assert not pose_denies_lag(known(driven(Model())), 0.01)


def test_pose_does_not_deny_that_means_are_late() -> None:
    assert not pose_denies_lag(counted(driven(Model()), 1), 0.01)


@pytest.mark.parametrize('known', [lambda run: run, without_pose, posed_by_its_twists])
def test_differences_of_encoders_do_not_make_a_robot_late(known: Callable[[Run], Run]) -> None:
    answer = identify([known(counted(driven(Model()), 1))], Model(), kinds=LATENESS)
    assert answer.verdict == 'nothing_missing'
    assert [it.lateness for it in answer.timings] == pytest.approx([0.01])


@pytest.mark.parametrize('half_a_step', [5e-4, 2e-3])
def test_means_over_the_steps_of_a_simulator_do_not_make_a_robot_late(half_a_step: float) -> None:
    run = without_pose(acted_before(counted(driven(Model()), 1), -half_a_step))
    answer = identify([run], Model(), kinds=LATENESS)
    assert answer.verdict == 'nothing_missing'
    told = {it.taken: it.lateness for it in answer.timings}
    assert told == pytest.approx({'mean': 0.01, 'force': half_a_step}, abs=1e-4)


def beside_a_gyro(run: Run) -> Run:
    """Return what encoders tell of a run's speed and way, and a gyro of its turn rate."""
    seen = counted(run, 1).odometry
    at_once = np.isin(run.odometry.time, seen.time)
    twist = np.column_stack([seen.twist[:, 0], run.odometry.twist[at_once, 1]])
    return replace(run, odometry=replace(seen, twist=twist))


@pytest.mark.parametrize(
    'known', [beside_a_gyro, lambda r: headed_by_its_turn_rate(beside_a_gyro(r))]
)
def test_encoders_beside_a_gyro_do_not_make_a_robot_late(known: Callable[[Run], Run]) -> None:
    answer = identify([known(driven(Model()))], Model(), kinds=LATENESS)
    assert answer.verdict == 'nothing_missing'
    assert [(it.taken, it.lateness) for it in answer.timings] == [('speed', pytest.approx(0.01))]


def test_lost_messages_do_not_hide_that_encoders_tell_means() -> None:
    run = counted(driven(Model()), 1)
    seen = run.odometry
    kept = np.random.default_rng(1).random(len(seen.time)) > 0.02
    lossy = Odometry(seen.time[kept], seen.twist[kept], None)
    answer = identify([replace(run, odometry=lossy)], Model(), kinds=LATENESS)
    assert answer.verdict == 'nothing_missing'
    assert [it.taken for it in answer.timings] == ['mean']


def test_means_are_beyond_doubt_before_anything_is_searched() -> None:
    seen = (run := driven(Model())).odometry
    seldom = Odometry(seen.time[::5], seen.twist[::5], seen.pose[::5])
    run = counted(replace(run, odometry=seldom), 1)
    base, _ = fitted(run)
    older = Ages(base, Recordings((run,), ())).beyond_doubt(LATENESS)
    assert older.what == 'twists'


def test_late_robot_does_not_make_means_beyond_doubt() -> None:
    late = driven(Model(effects=(ActuatorDelay(0.012),)))
    run = without_pose(late)
    base, _ = fitted(run)
    assert Ages(base, Recordings((run,), ())).beyond_doubt(LATENESS) is None


def test_true_pose_lets_a_delay_within_an_interval_be_named() -> None:
    answer = identify([driven(Model(effects=(ActuatorDelay(0.012),)))], Model())
    (effect,) = answer.effects
    assert effect.name == 'actuator_delay'
    assert not answer.timings


def test_rolling_mean_hides_no_delay() -> None:
    run = counted(driven(Model(effects=(ActuatorDelay(0.08),))), 5)
    (effect,) = identify([run], Model(), kinds=LATENESS).effects
    assert effect.name == 'actuator_delay'
    assert effect.parameters['time'].value == pytest.approx(0.08, abs=0.002)


def test_delay_beside_coarse_means_is_told_less_what_they_are_late() -> None:
    run = counted(driven(Model(effects=(ActuatorDelay(0.06),))), 1)
    answer = identify([run], Model(), kinds=LATENESS)
    (effect,), (timing,) = answer.effects, answer.timings
    assert timing.taken == 'counts'
    assert effect.parameters['time'].value == pytest.approx(0.06, abs=0.001)
