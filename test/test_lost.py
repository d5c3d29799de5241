"""Forces that a recording lost: put in between their neighbours, and known to be unsure."""

import numpy as np
import pytest
from drives import LEFT, START, drive, messages
from hypothesis import given
from hypothesis import strategies as st

from diffbot_sim.bags import read_run
from diffbot_sim.bags.folder import write_bag
from diffbot_sim.bags.lost import lost, with_lost
from diffbot_sim.bags.series import Ordered

TICK = 20_000_000  # [ns]


def forces(ticks: np.ndarray, values: np.ndarray) -> Ordered:
    """Return forces that came at these ticks."""
    return Ordered(LEFT, START + TICK * ticks, values[:, None].astype(float), 0, 0, 0)


def without(*which: int, count: int = 100) -> Ordered:
    """Return forces of a steady rate, as large as their tick, of which some are missing."""
    ticks = np.delete(np.arange(count), which)
    return forces(ticks, ticks)


def test_lost_forces_are_counted_after_the_one_before_them():
    missing = lost(without(10, 50, 51))
    assert {int(i): int(missing[i]) for i in np.flatnonzero(missing)} == {9: 1, 48: 2}


def test_lost_forces_lie_between_their_neighbours():
    found = with_lost(without(10, 50, 51))
    np.testing.assert_array_equal(found.stamp, START + TICK * np.arange(100))
    np.testing.assert_allclose(found.values[:, 0], np.arange(100))


def test_lost_forces_alone_are_unsure():
    found = with_lost(without(10, 50, 51))
    assert np.flatnonzero(found.values[:, 1]).tolist() == [10, 50, 51]


def test_a_lost_force_between_equal_ones_is_sure():
    ticks = np.delete(np.arange(100), 10)
    assert np.all(with_lost(forces(ticks, np.full(99, 3.0))).values == [3.0, 0.0])


def test_impulse_is_as_unsure_as_the_step_over_the_time_that_nobody_heard():
    ticks = np.delete(np.arange(100), [50, 51])
    found = with_lost(forces(ticks, np.where(ticks < 51, 0.0, 6.0)))
    impulse = found.values[50:52, 1].sum() * TICK * 1e-9
    assert impulse == pytest.approx((3.0 * 2 * TICK * 1e-9) ** 2)


def test_forces_that_are_late_are_not_lost():
    ticks = np.arange(100.0)
    ticks[20:80:10] += [0.4, 0.5, 0.6, 0.9, 0.95, 1.0 - 1e-6]
    stamps = (START + TICK * ticks).astype(np.int64)
    assert not lost(Ordered(LEFT, stamps, ticks[:, None], 0, 0, 0)).any()


def test_force_that_is_held_through_a_silence_is_as_unsure_as_any():
    ticks = np.delete(np.arange(200), np.arange(20, 90))
    found = with_lost(forces(ticks, ticks % 7))
    (at,) = np.flatnonzero(found.values[:, 1])
    assert found.stamp[at] == START + 20 * TICK
    assert found.values[at] == pytest.approx([19 % 7, 71 * 0.02 * np.var(ticks % 7)])


@given(st.lists(st.floats(-1e3, 1e3), min_size=3, max_size=60))
def test_forces_of_which_none_was_lost_are_as_they_were(values):
    given_ = forces(np.arange(len(values)), np.array(values))
    found = with_lost(given_)
    np.testing.assert_array_equal(found.values[:, 0], values)
    assert not found.values[:, 1].any()


@pytest.mark.parametrize(
    'ticks',
    [
        np.cumsum(np.random.default_rng(1).uniform(1.0, 9.0, 99)).astype(int),  # at any time
        np.cumsum(np.random.default_rng(1).integers(1, 5, 99)),  # when they change
        np.delete(np.arange(0, 4000, 40), [10, 50]),  # slowly
        np.delete(np.arange(200), np.arange(20, 90)),  # with a silence
    ],
)
def test_forces_that_were_not_sent_are_not_lost(ticks):
    assert not lost(forces(ticks, ticks)).any()


def test_what_was_lost_is_told(tmp_path):
    told = messages(drive())
    left = [i for i, message in enumerate(told) if message.topic == LEFT]
    write_bag(tmp_path / 'drive', [m for i, m in enumerate(told) if i not in left[20:60:10]])
    found = read_run(tmp_path / 'drive')
    assert '4 messages of /left_wheel/force are missing, of 100' in found.notes[0]
    assert np.flatnonzero(found.run.commands.unsure[:, 1]).tolist() == [20, 30, 40, 50]


@given(st.integers(0, 1000))
def test_stamps_that_jitter_hide_no_loss(seed):
    jitter = np.random.default_rng(seed).uniform(-0.15, 0.15, 98)
    ticks = np.delete(np.arange(100.0), [10, 50]) + jitter
    stamps = (START + TICK * ticks).astype(np.int64)
    missing = lost(Ordered(LEFT, stamps, ticks[:, None], 0, 0, 0))
    assert np.flatnonzero(missing).tolist() == [9, 48]
