"""What a recording is known to hold: forces end, begin late, and clocks are set while it runs."""

from pathlib import Path

import numpy as np
import pytest
from drives import LEFT, ODOM, RIGHT, START, drive, messages, stamped, without_poses

from diffbot_sim.bags import RecordedRun, read_run
from diffbot_sim.bags.folder import Message, write_bag
from diffbot_sim.bags.messages import wrench
from diffbot_sim.errors import BagError
from diffbot_sim.records import Commands, Odometry, Run

SECOND = 10**9


def slowly(run: Run | None = None) -> list[Message]:
    """Make the messages of a drive of ten seconds; its poses are left unfilled."""
    items = messages(without_poses(run or drive()))
    return [stamped(m, START + 10 * (m.stamp - START)) for m in items]


def read(folder: Path, items: list[Message]) -> RecordedRun:
    write_bag(folder / 'drive', items)
    return read_run(folder / 'drive')


def test_odometry_after_the_last_of_a_force_that_acts_is_left_out(tmp_path):
    found = read(tmp_path, [m for i, m in enumerate(slowly()) if m.topic != LEFT or i < 200])
    assert found.notes == (
        f'drive: {LEFT} ends 3.3 s before the odometry, with 0.941688 N; left out from there on',
    )
    assert found.run.odometry.time[-1] == pytest.approx(6.6)


def test_a_force_that_ends_with_none_is_held(tmp_path):
    kept = [m for i, m in enumerate(slowly()) if m.topic != LEFT or i < 150]
    last = max(i for i, m in enumerate(kept) if m.topic == LEFT)
    stamp = START + round(4.9 * SECOND)
    kept[last] = Message(kept[last].stamp, LEFT, wrench(stamp, '', 0.0))
    found = read(tmp_path, kept)
    assert found.notes == (
        f'drive: {LEFT} ends 5.0 s before the odometry; its last force is held',
    )
    assert found.run.odometry.time[-1] == pytest.approx(9.9)


@pytest.mark.parametrize('sent', [range(1), range(10), [*range(20), *range(40, 55)]])
def test_a_force_that_is_sent_when_it_changes_is_held(tmp_path, sent):
    kept = [m for i, m in enumerate(slowly()) if m.topic != LEFT or i // 3 in sent]
    found = read(tmp_path, kept)
    assert 'its last force is held' in found.notes[-1]
    assert found.run.odometry.time[-1] == pytest.approx(9.9)


@pytest.mark.parametrize('later', [-8, 60])
def test_one_force_that_shares_no_time_with_the_odometry_is_told(tmp_path, later):
    shift = START + later * SECOND
    forces = [stamped(m, shift + 10 * (m.stamp - START)) for m in slowly() if m.topic == LEFT]
    items = [m for i, m in enumerate(slowly()) if m.topic != LEFT and (m.topic != ODOM or i > 120)]
    with pytest.raises(BagError, match=f'{LEFT} and odometry do not overlap in time'):
        read(tmp_path, [*items, *forces])


def test_odometry_that_moves_before_forces_begin_is_left_out(tmp_path):
    found = read(tmp_path, [m for i, m in enumerate(slowly()) if m.topic != LEFT or i > 60])
    assert found.notes == (
        f'drive: {LEFT} begins 2.0 s after the odometry, which moves: left out until then',
    )
    assert len(found.run.odometry.time) == 80


def test_a_robot_that_rests_before_forces_begin_is_believed(tmp_path):
    rests = np.arange(100) < 30
    twist = drive().odometry.twist * ~rests[:, None]
    odom = Odometry(drive().odometry.time, twist, drive().odometry.pose)
    slow = slowly(Run('drive', drive().commands, odom))
    found = read(tmp_path, [m for i, m in enumerate(slow) if m.topic != LEFT or i > 60])
    assert found.notes == (
        f'drive: {LEFT} begins 2.0 s after the odometry; taken as 0 until then',
    )
    assert len(found.run.odometry.time) == 100


def test_twists_that_nobody_filled_are_told(tmp_path):
    odom = Odometry(
        drive().odometry.time, drive().odometry.twist * [1.0, 0.0], drive().odometry.pose
    )
    (note,) = read(tmp_path, messages(Run('drive', drive().commands, odom))).notes
    assert f'twist.angular.z of {ODOM} is 0 throughout though the poses move' in note


def long_drive() -> list[Message]:
    time = np.arange(200) / 50.0
    force, twist = np.sin(time)[:, None] * [1.0, 0.9], np.cos(time)[:, None] * [1.0, 0.5]
    pose = np.column_stack([np.sin(time), time, 0.5 * np.sin(time)])
    return messages(Run('drive', Commands(time, force), Odometry(time, twist, pose)))


def with_clock_set(by: float, items: list[Message]) -> list[Message]:
    """Return messages of which the odometry of the second half is stamped later [s]."""
    late = range(len(items) // 2, len(items))
    return [
        stamped(m, m.stamp + round(by * SECOND)) if m.topic == ODOM and i in late else m
        for i, m in enumerate(items)
    ]


@pytest.mark.parametrize('by', [10.0, 0.3, -0.4, -20.0])
def test_a_clock_that_is_set_while_it_records_is_set_back(tmp_path, by):
    found = read(tmp_path, with_clock_set(by, long_drive()))
    assert found.notes == (
        f'drive: the stamps of {ODOM} leap by {by:+.3g} s after 2.0 s, its receipts do not; '
        'that was taken back',
    )
    np.testing.assert_allclose(found.run.odometry.time, np.arange(200) / 50.0, atol=1e-9)


def test_messages_that_wait_for_a_busy_recorder_are_no_leap(tmp_path):
    busy = [
        m._replace(stamp=max(m.stamp, START + 3 * SECOND)) if m.stamp > START + 2 * SECOND else m
        for m in long_drive()
    ]
    assert read(tmp_path, busy).notes == ()


def test_messages_lost_by_a_busy_recorder_are_no_leap(tmp_path):
    """Ten wait, those after them are lost; the receipts of what waited are all late."""
    begin, end = START + 2 * SECOND, START + 3 * SECOND
    kept = [m for m in long_drive() if not begin + SECOND // 5 < m.stamp < end]
    late = [m._replace(stamp=end) if begin < m.stamp < end else m for m in kept]
    missing = '39 messages of {} are missing, of 200; those forces are taken to lie between'
    assert read(tmp_path, late).notes == tuple(
        f'drive: {missing.format(topic)} their neighbours' for topic in (LEFT, RIGHT)
    )
