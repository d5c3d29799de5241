"""Bag to run: what is found, by which clock, and what is left out."""

from dataclasses import replace

import numpy as np
from drives import LEFT, ODOM, RIGHT, START, TIME, drive, messages, stamped

from diffbot_sim.bags import Topics, read_run, write_run
from diffbot_sim.bags.folder import Message, write_bag
from diffbot_sim.bags.messages import wrench
from diffbot_sim.records import Commands


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


def test_a_few_messages_with_nan_are_left_out_and_told(tmp_path):
    items = messages(drive())
    items[150] = items[150]._replace(content=wrench(items[150].stamp, '', np.nan))
    write_bag(tmp_path / 'drive', items)
    found = read_run(tmp_path / 'drive')
    assert np.isfinite(found.run.commands.force).all()
    assert found.notes == (f'drive: left out 1 messages of {RIGHT} that are not finite',)


def test_holes_in_the_odometry_are_told(tmp_path):
    late = [m._replace(stamp=m.stamp + 4 * 10**9) for m in messages(drive())[150:]]
    late = [stamped(message, message.stamp) for message in late]
    write_bag(tmp_path / 'drive', [*messages(drive())[:150], *late])
    (note,) = read_run(tmp_path / 'drive').notes
    assert 'drive: the odometry has holes: 4.0 s from 0.5 s on; ' in note


def test_odometry_that_is_always_slow_has_no_holes(tmp_path):
    slow = [stamped(m, START + 200 * (m.stamp - START)) for m in messages(drive())]
    write_bag(tmp_path / 'drive', [m._replace(stamp=START + 10**9) for m in slow])
    assert read_run(tmp_path / 'drive').notes == ()


def test_a_pose_that_nobody_filled_is_no_pose(tmp_path):
    for name, pose in (('without', None), ('identity', np.zeros((100, 3)))):
        odom = replace(drive().odometry, pose=pose)
        write_run(tmp_path / name, replace(drive(), odometry=odom), START)
        assert read_run(tmp_path / name).run.odometry.pose is None
