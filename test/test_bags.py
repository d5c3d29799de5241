"""Bag to run: what is found, by which clock, and what is left out."""

from dataclasses import replace

import numpy as np
import pytest
from drives import LEFT, ODOM, RIGHT, START, TIME, drive, messages, stamped, without_poses

from diffbot_sim.bags import Topics, read_run, write_run
from diffbot_sim.bags.folder import Message, write_bag
from diffbot_sim.bags.messages import wrench
from diffbot_sim.bags.raw import topics_in
from diffbot_sim.records import Commands, Odometry, Run


def test_the_storage_file_alone_is_a_bag_too(tmp_path):
    write_run(tmp_path / 'drive', drive(), START)
    (tmp_path / 'drive' / 'metadata.yaml').unlink()
    assert read_run(tmp_path / 'drive' / 'drive.mcap').start_ns == START


def test_forces_of_unlike_stamps_are_held_on_the_union_of_both(tmp_path):
    late = [message for message in messages(drive()) if message.topic == ODOM]
    left = [(0, 1.0), (200_000_000, 2.0)]
    right = [(100_000_000, 5.0), (200_000_000, 6.0)]
    late += [Message(START + t, LEFT, wrench(START + t, '', f)) for t, f in left]
    late += [Message(START + t, RIGHT, wrench(START + t, '', f)) for t, f in right]
    write_bag(tmp_path / 'drive', late)
    commands = read_run(tmp_path / 'drive').run.commands
    np.testing.assert_array_equal(commands.time, [0.0, 0.1, 0.2])
    np.testing.assert_array_equal(commands.force, [[0.0, 1.0], [5.0, 1.0], [6.0, 2.0]])


def test_run_time_starts_with_the_first_message_of_either_kind(tmp_path):
    commands = replace(drive().commands, time=TIME - 0.5)
    write_run(tmp_path / 'drive', replace(drive(), commands=commands), START)
    found = read_run(tmp_path / 'drive')
    assert found.start_ns == START - 500_000_000
    assert found.run.commands.time[0] == 0.0
    assert found.run.odometry.time[0] == 0.5


def test_forces_as_they_acted_are_preferred_to_commands(tmp_path):
    extra = [Message(START, LEFT + '_cmd', wrench(START, '', 99.0))]
    write_bag(tmp_path / 'drive', messages(drive()) + extra)
    assert read_run(tmp_path / 'drive').run.commands.force.max() <= 1.0


def test_commands_serve_where_no_forces_were_recorded(tmp_path):
    as_commands = [
        message if message.topic == ODOM else message._replace(topic=message.topic + '_cmd')
        for message in messages(drive())
    ]
    write_bag(tmp_path / 'drive', as_commands)
    found = read_run(tmp_path / 'drive').run.commands.force
    np.testing.assert_array_equal(found, drive().commands.force)


def test_one_robot_is_found_in_its_namespace(tmp_path):
    write_bag(tmp_path / 'drive', messages(drive(), '/fleet/ant'))
    assert read_run(tmp_path / 'drive').run.odometry.time.size == 100


def test_topics_written_without_their_slash_are_found(tmp_path):
    bare = [m._replace(topic=m.topic.removeprefix('/')) for m in messages(drive())]
    write_bag(tmp_path / 'drive', bare)
    assert len(read_run(tmp_path / 'drive').run.commands.force) == 100
    assert set(topics_in(tmp_path / 'drive')) == {LEFT, RIGHT, ODOM}


def test_one_robot_of_several_can_be_named(tmp_path):
    bee = replace(drive(), commands=Commands(TIME, np.full((100, 2), 7.0)))
    write_bag(tmp_path / 'drive', messages(drive(), '/ant') + messages(bee, '/bee'))
    topics = Topics('bee' + LEFT, 'bee' + RIGHT, '/bee/odom')
    assert np.all(read_run(tmp_path / 'drive', topics).run.commands.force == 7.0)


def test_receipt_serves_for_all_topics_where_one_has_no_stamps(tmp_path):
    half = [stamped(item, 0) if item.topic == LEFT else item for item in messages(drive())]
    shifted = [item._replace(stamp=item.stamp + 40) for item in half]
    write_bag(tmp_path / 'drive', shifted)
    found = read_run(tmp_path / 'drive')
    assert found.start_ns == START + 40
    assert found.notes == ('drive: not all messages are stamped; used the times of receipt',)


def test_a_simulation_clock_may_start_at_zero(tmp_path):
    late = [item._replace(stamp=item.stamp + START) for item in messages(drive(), start=0)]
    write_bag(tmp_path / 'drive', late)
    assert read_run(tmp_path / 'drive').start_ns == 0


def test_messages_are_sorted_and_the_last_of_equal_stamps_counts(tmp_path):
    items = messages(drive())
    again = Message(START + 10**9, LEFT, wrench(START, '', 42.0))
    write_bag(tmp_path / 'drive', [*items, again])
    force = read_run(tmp_path / 'drive').run.commands.force
    assert force[0, 1] == 42.0
    assert len(force) == 100


@pytest.mark.parametrize('wrong', [np.nan, -1e30])
def test_a_few_messages_with_nan_are_left_out_and_told(tmp_path, wrong):
    items = messages(drive())
    items[150] = items[150]._replace(content=wrench(items[150].stamp, '', wrong))
    write_bag(tmp_path / 'drive', items)
    found = read_run(tmp_path / 'drive')
    assert np.isfinite(found.run.commands.force).all()
    assert found.notes == (
        f'drive: left out 1 messages of {RIGHT} that are not finite, or beyond 1e+06',
    )


@pytest.mark.parametrize('absurd', [1e4, -1e5])
def test_a_number_out_of_all_proportion_is_left_out_and_told(tmp_path, absurd):
    items = messages(drive())
    items[150] = items[150]._replace(content=wrench(items[150].stamp, '', absurd))
    write_bag(tmp_path / 'drive', items)
    found = read_run(tmp_path / 'drive')
    assert np.abs(found.run.commands.force).max() <= 1.0
    assert found.notes == (
        f'drive: left out 1 messages of {RIGHT} whose numbers are more than 100 times as large '
        'as nearly all others',
    )


def test_a_robot_that_moves_for_moments_only_is_believed(tmp_path):
    time = np.arange(20_000) / 100.0
    noise = np.random.default_rng(3).normal(0.0, 1e-3, (len(time), 2))
    moves = np.abs(time - 150.0)[:, None] < 0.8
    pose = np.zeros((len(time), 3))
    run = Run(
        'drive', Commands(time, 5.0 * moves * [1.0, 0.9]), Odometry(time, noise + moves, pose)
    )
    write_run(tmp_path / 'drive', run, START)
    found = read_run(tmp_path / 'drive')
    assert found.notes == ()
    assert len(found.run.odometry.time) == len(time)


def test_holes_in_the_odometry_are_told(tmp_path):
    late = [m._replace(stamp=m.stamp + 4 * 10**9) for m in messages(without_poses(drive()))[150:]]
    late = [stamped(message, message.stamp) for message in late]
    write_bag(tmp_path / 'drive', [*messages(without_poses(drive()))[:150], *late])
    (note,) = read_run(tmp_path / 'drive').notes
    assert f'drive: {ODOM} has holes: 4.0 s from 0.5 s on; ' in note


def test_odometry_that_is_always_slow_has_no_holes(tmp_path):
    slow = [stamped(m, START + 200 * (m.stamp - START)) for m in messages(without_poses(drive()))]
    write_bag(tmp_path / 'drive', [m._replace(stamp=START + 10**9) for m in slow])
    assert read_run(tmp_path / 'drive').notes == ()


def test_a_pose_that_nobody_filled_is_no_pose(tmp_path):
    for name, pose in (('without', None), ('identity', np.zeros((100, 3)))):
        odom = replace(drive().odometry, pose=pose)
        write_run(tmp_path / name, replace(drive(), odometry=odom), START)
        assert read_run(tmp_path / name).run.odometry.pose is None


def test_forces_that_fall_silent_while_the_robot_moves_are_told(tmp_path):
    slow = [stamped(m, START + 10 * (m.stamp - START)) for m in messages(without_poses(drive()))]
    kept = [m for i, m in enumerate(slow) if m.topic != RIGHT or not 90 < i < 180]
    write_bag(tmp_path / 'drive', kept)
    (note,) = read_run(tmp_path / 'drive').notes
    assert f'{RIGHT} has holes: 3.0 s from 3.0 s on; the last force' in note


def test_poses_that_hold_nan_leave_the_twists(tmp_path):
    odom = replace(drive().odometry, pose=np.full((100, 3), np.nan))
    write_run(tmp_path / 'drive', replace(drive(), odometry=odom), START)
    found = read_run(tmp_path / 'drive')
    assert found.run.odometry.pose is None
    assert found.notes == ('drive: the poses hold NaN or infinity; used the twists alone',)


def test_poses_that_never_turn_beside_twists_that_do_are_left_out(tmp_path):
    assert drive().odometry.pose is not None
    odom = replace(drive().odometry, pose=drive().odometry.pose * [1.0, 1.0, 0.0])
    write_run(tmp_path / 'drive', replace(drive(), odometry=odom), START)
    found = read_run(tmp_path / 'drive')
    assert found.run.odometry.pose is None
    assert found.notes == (
        'drive: the poses never turn though the twists do; used the twists alone',
    )


def test_some_messages_of_equal_stamps_are_told(tmp_path):
    items = messages(drive())
    items += [m._replace(stamp=m.stamp + 10**6) for m in items if m.topic == LEFT][:20]
    write_bag(tmp_path / 'drive', items)
    (note,) = read_run(tmp_path / 'drive').notes
    assert f'20 of 120 messages of {LEFT} bear the stamp of another' in note
