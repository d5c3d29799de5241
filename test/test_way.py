"""The way that wheels have come, as noisy twists and poses tell it."""

import numpy as np
import pytest

from diffbot_sim.identification.recordings.stretches import split
from diffbot_sim.identification.recordings.way import measured_heading, measured_way
from diffbot_sim.physics.kinematics import path_of
from diffbot_sim.records import Commands, Odometry, Run

TIME = np.arange(0.0, 120.0, 0.02)
SPEED = 0.4 * np.sin(0.7 * TIME) + 0.1
RATE = 0.8 * np.cos(0.3 * TIME)
NOISE = np.array([0.01, 0.02])


def added_up(twist):
    steps = 0.5 * np.diff(TIME)[:, None] * (twist[1:] + twist[:-1])
    return np.vstack([np.zeros(2), np.cumsum(steps, axis=0)])


def pose_of(twist):
    way, turn = added_up(twist).T
    middle, half = 0.5 * (turn[1:] + turn[:-1]), 0.5 * np.diff(turn)
    chords = (np.diff(way) * np.sinc(half / np.pi))[:, None]
    place = np.cumsum(chords * np.column_stack([np.cos(middle), np.sin(middle)]), axis=0)
    return np.column_stack([np.vstack([np.zeros(2), place]), turn])


@pytest.fixture
def moved():
    return np.column_stack([SPEED, RATE])


@pytest.fixture
def noisy(moved):
    return moved + NOISE * np.random.default_rng(0).normal(size=moved.shape)


def test_a_pose_that_knows_better_corrects_the_sum_of_noisy_twists(moved, noisy):
    pose = pose_of(moved) + 1e-3 * np.random.default_rng(1).normal(size=(len(TIME), 3))
    told, way = measured_way(Odometry(TIME, noisy, pose)), added_up(moved)
    assert np.abs(told - way).max() < 0.5 * np.abs(added_up(noisy) - way).max()


def test_arcs_between_samples_are_not_taken_for_their_chords():
    turn = np.linspace(0.0, 20.0, 200)
    circle = np.column_stack([np.sin(turn), 1.0 - np.cos(turn), turn])
    assert path_of(circle)[-1] == pytest.approx([20.0, 20.0], rel=1e-9)


def test_a_pose_made_of_the_twist_tells_no_more_than_its_sum(noisy):
    told = measured_way(Odometry(TIME, noisy, pose_of(noisy)))
    assert np.array_equal(told, added_up(noisy))


def test_means_since_the_sample_before_add_up_to_all_of_the_way(moved):
    way = added_up(moved)
    means = np.vstack([np.zeros(2), np.diff(way, axis=0) / np.diff(TIME)[:, None]])
    assert measured_way(Odometry(TIME, means, None, (True, True))) == pytest.approx(way)


def test_without_a_pose_twists_are_added_up(noisy):
    assert np.array_equal(measured_way(Odometry(TIME, noisy)), added_up(noisy))


def test_a_pose_that_is_noisier_than_the_sum_of_twists_is_not_asked(moved, noisy):
    pose = pose_of(moved) + 0.05 * np.random.default_rng(1).normal(size=(len(TIME), 3))
    assert np.array_equal(measured_way(Odometry(TIME, noisy, pose)), added_up(noisy))


def test_a_pose_that_was_set_anew_on_the_way_is_not_asked(moved, noisy):
    pose = pose_of(moved)
    pose[3000:, 0] += 5.0
    assert np.array_equal(measured_way(Odometry(TIME, noisy, pose)), added_up(noisy))


@pytest.mark.parametrize('count', [50, 200])
def test_a_short_recording_has_a_way_too(noisy, moved, count):
    seen = Odometry(TIME[:count], noisy[:count], pose_of(moved)[:count])
    assert np.array_equal(measured_way(seen), added_up(noisy)[:count])


def heading_of(turned, rate, mean=False):
    """Return the heading that is taken for measured where a pose has turned so."""
    twist, pose = np.column_stack([SPEED, rate]), np.zeros((len(TIME), 3))
    pose[:, 2] = turned
    return measured_heading(Odometry(TIME, twist, pose, (mean, mean)))


def test_heading_that_adds_up_rates_of_the_moment_is_taken_back_by_half_a_step(moved):
    turn, steps = added_up(moved)[:, 1], RATE * 0.02
    behind = np.concatenate([[0.0], np.cumsum(steps[:-1])])
    ahead = behind + steps - steps[0]
    for told in (behind, ahead):
        heading = heading_of(told, RATE)
        assert heading - heading[0] == pytest.approx(turn, abs=1e-9)


def test_heading_that_adds_up_means_is_right_as_it_is(moved):
    turn = added_up(moved)[:, 1]
    means = np.append(0.0, np.diff(turn) / np.diff(TIME))
    assert np.array_equal(heading_of(turn, means, mean=True), turn)


def test_heading_of_a_compass_is_right_as_it_is(noisy, moved):
    turn = added_up(moved)[:, 1]
    assert np.array_equal(heading_of(turn, noisy[:, 1]), turn)


def test_heading_without_a_pose_goes_on_where_data_are_held_out(moved):
    run = Run('run', Commands(TIME, np.zeros((len(TIME), 2))), Odometry(TIME, moved))
    (fitted,), (held_out,) = split([run])
    assert held_out.heading[0] == pytest.approx(fitted.heading[-1], abs=0.02)
