"""Arrays to bag: they come back, and nothing else in the folder is harmed."""

from dataclasses import replace

import numpy as np
import pytest
from drives import START, TIME, drive
from rosbags.rosbag2 import Reader

from diffbot_sim.bags import Topics, read_run, write_run, write_series, write_trajectory
from diffbot_sim.errors import BagError
from diffbot_sim.records import Commands, Trajectory


def test_predictions_are_a_bag_of_their_own(tmp_path):
    pair, odom = np.column_stack([TIME, 2 * TIME]), drive().odometry
    predicted = Trajectory(TIME, odom.twist, odom.pose, pair, pair, 2 * pair, 3 * pair)
    write_trajectory(tmp_path / 'out', Commands(TIME, pair), predicted, START)
    found = read_run(tmp_path / 'out').run
    np.testing.assert_array_equal(found.odometry.twist, odom.twist)
    np.testing.assert_array_equal(found.commands.force, pair)
    friction = Topics('/left_wheel/friction', '/right_wheel/friction')
    found = read_run(tmp_path / 'out', friction).run
    np.testing.assert_array_equal(found.commands.force, 3 * pair)


def test_series_take_their_type_from_the_end_of_their_name(tmp_path):
    pair = np.column_stack([TIME, 2 * TIME])
    write_series(tmp_path / 'out', {'/a/twist': (TIME, pair), '/b/wrench': (TIME, pair)})
    with Reader(tmp_path / 'out') as reader:
        found = {item.topic: (item.msgtype, item.msgcount) for item in reader.connections}
    assert found == {
        '/a/twist': ('geometry_msgs/msg/TwistStamped', 100),
        '/b/wrench': ('geometry_msgs/msg/WrenchStamped', 100),
    }


def test_a_computed_bag_is_replaced_and_other_files_stay(tmp_path):
    (tmp_path / 'out').mkdir()
    (tmp_path / 'out' / 'notes.txt').write_text('keep')
    for start in (0, START):
        write_run(tmp_path / 'out', drive(), start)
    names = sorted(file.name for file in (tmp_path / 'out').iterdir())
    assert names == ['metadata.yaml', 'notes.txt', 'out.mcap']
    assert read_run(tmp_path / 'out').start_ns == START


def test_a_recorded_bag_is_never_replaced(tmp_path):
    write_run(tmp_path / 'out', drive())
    metadata = tmp_path / 'out' / 'metadata.yaml'
    metadata.write_text(metadata.read_text().replace('computed_by', 'driver'))
    with pytest.raises(BagError, match='holds a recorded bag, which is kept'):
        write_run(tmp_path / 'out', drive())


def test_a_place_that_cannot_be_written_is_told(tmp_path):
    (tmp_path / 'file').write_text('')
    with pytest.raises(BagError, match='a file is in the way'):
        write_run(tmp_path / 'file', drive())
    with pytest.raises(BagError, match='cannot be written'):
        write_run(tmp_path / 'file' / 'out', drive())


def test_a_written_run_is_read_back(tmp_path):
    write_run(tmp_path / 'drive', drive(), START)
    found = read_run(tmp_path / 'drive')
    assert (found.run.name, found.start_ns, found.notes) == ('drive', START, ())
    np.testing.assert_array_equal(found.run.commands.time, TIME)
    np.testing.assert_array_equal(found.run.commands.force, drive().commands.force)
    np.testing.assert_array_equal(found.run.odometry.time, TIME)
    np.testing.assert_array_equal(found.run.odometry.twist, drive().odometry.twist)
    np.testing.assert_allclose(found.run.odometry.pose, drive().odometry.pose, atol=1e-12)


def test_stamps_come_back_to_the_nanosecond(tmp_path):
    ticks = np.arange(100) * 10_000_019
    run = replace(drive(), odometry=replace(drive().odometry, time=ticks / 1e9))
    write_run(tmp_path / 'drive', run, START)
    np.testing.assert_array_equal(read_run(tmp_path / 'drive').stamps, START + ticks)


@pytest.mark.parametrize('name', ['out_0.mcap', 'out.db3', 'out_0/out_0.mcap'])
def test_a_recording_that_was_cut_off_is_not_buried(tmp_path, name):
    part = tmp_path / 'out' / name
    part.parent.mkdir(parents=True)
    part.write_bytes(b'cut')
    with pytest.raises(BagError, match='a recording that was cut off, which is kept'):
        write_run(tmp_path / 'out', drive())
