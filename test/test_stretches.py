"""Recordings as identification takes them: faster than it needs, and stamped in any way."""

import numpy as np
import pytest

from diffbot_sim.identification.recordings.stretches import thin
from diffbot_sim.records import Array, Commands, Odometry, Run


def run_with(time: Array, force: Array) -> Run:
    """Return a run of these commands, with odometry that matters to nobody."""
    seen = np.arange(0.0, 2.0, 0.02)
    return Run('run', Commands(time, force), Odometry(seen, np.zeros((len(seen), 2)), None))


def stamped_one_after_the_other(rate: float, apart: float) -> Commands:
    """Return two seconds of commands, the left wheel's stamped later than the right one's [s]."""
    first = np.arange(0.0, 2.0, 1.0 / rate)
    time = np.column_stack([first, first + apart]).ravel()
    right, left = np.random.default_rng(1).uniform(-5.0, 5.0, (2, len(first)))
    before = np.concatenate([left[:1], left[:-1]])
    return Commands(time, np.column_stack([right, before, right, left]).reshape(-1, 2))


def impulse(commands: Commands, until: Array) -> Array:
    """Return what was held since time 0 [N·s], shape (k, 2)."""
    held = np.diff(commands.time)[:, None] * commands.force[:-1]
    summed = np.concatenate([np.zeros((1, 2)), np.cumsum(held, axis=0)])
    columns = [np.interp(until, commands.time, column) for column in summed.T]
    return np.column_stack(columns)


def test_wheels_stamped_one_after_the_other_are_of_one_tick():
    given = stamped_one_after_the_other(50.0, 1e-4)
    taken = thin(run_with(given.time, given.force)).commands
    np.testing.assert_array_equal(taken.time, given.time[1::2])
    np.testing.assert_array_equal(taken.force, given.force[1::2])


def test_wheels_stamped_by_turns_are_taken_as_they_are():
    given = stamped_one_after_the_other(50.0, 0.008)
    run = run_with(given.time, given.force)
    assert thin(run) is run


@pytest.mark.parametrize('apart', [2e-4, 5e-4, 7e-4])
def test_fewer_commands_give_the_same_impulse(apart):
    given = stamped_one_after_the_other(1000.0, apart)
    taken = thin(run_with(given.time, given.force)).commands
    assert len(taken.time) < len(given.time) / 8
    np.testing.assert_allclose(
        impulse(taken, taken.time), impulse(given, taken.time), rtol=0.0, atol=1e-12
    )


def test_what_is_slow_enough_stays_as_it_is():
    time = np.arange(0.0, 2.0, 0.01)
    run = run_with(time, np.ones((len(time), 2)))
    assert thin(run) is run


def test_pause_that_is_longer_than_the_drive_takes_no_command():
    drive = np.arange(0.0, 2.0, 0.01)
    time = np.concatenate([drive, 100.0 + drive])
    run = run_with(time, np.ones((len(time), 2)))
    assert thin(run) is run
