"""Ticks that are due: made up for when late, within a limit, and never lost in silence."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from diffbot_sim.nodes.pace import AT_ONCE, LONGEST_DEBT, Pace


def test_ticks_are_due_at_every_period():
    pace = Pace(0.01, now=0.0)
    assert [pace.due(now) for now in (0.0, 0.005, 0.035)] == [(1, 0), (0, 0), (3, 0)]


def test_a_stall_is_made_up_for_in_small_portions():
    pace = Pace(0.01, now=0.0)
    made = [pace.due(0.505 + 0.01 * turn)[0] for turn in range(8)]
    assert max(made) == AT_ONCE
    assert sum(made) == 51 + 7  # all that were due


def test_a_debt_of_more_than_a_second_is_given_up_and_told():
    made, given_up = Pace(0.01, now=0.0).due(3.005)
    assert made == AT_ONCE
    assert given_up == pytest.approx((3.005 - LONGEST_DEBT) / 0.01, abs=1.0)


def test_slow_ticks_are_in_debt_for_a_second_too():
    assert Pace(0.4, now=0.0).due(3.9) == (2, 8)


@given(st.floats(1e-4, 0.1), st.lists(st.floats(0.0, 2.0), min_size=1, max_size=20))
def test_every_tick_is_made_given_up_or_still_owed(period, waits):
    pace, now, told = Pace(period, now=0.0), 0.0, 0
    for wait in waits:
        now += wait
        told += sum(pace.due(now))
    while portion := sum(pace.due(now)):
        told += portion
    assert told == pytest.approx(now / period + 1.0, abs=1.01)
