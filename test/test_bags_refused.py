"""Bags that cannot be used: each says why in one line."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from drives import LEFT, ODOM, RIGHT, START, TIME, drive, messages, stamped

from diffbot_sim.bags import Topics, read_run, write_run
from diffbot_sim.bags.folder import METADATA, Message, write_bag
from diffbot_sim.bags.messages import twist
from diffbot_sim.errors import BagError


def told(path: Path, topics: Topics | None = None) -> str:
    with pytest.raises(BagError) as caught:
        read_run(path, topics)
    text = str(caught.value)
    assert text.startswith(f'{path}: ')
    assert '\n' not in text
    return text


def told_of(tmp_path: Path, spoilt: list[Message]) -> str:
    write_bag(tmp_path / 'drive', spoilt)
    return told(tmp_path / 'drive')


def test_many_messages_with_nan_are_refused(tmp_path):
    odom = replace(drive().odometry, twist=np.where(TIME[:, None] < 0.05, np.nan, 1.0) * [1, 1])
    write_run(tmp_path / 'drive', replace(drive(), odometry=odom), START)
    assert '/odom: 5 of 100 messages hold NaN, infinity or' in told(tmp_path / 'drive')


def test_a_clock_that_stands_still_is_told(tmp_path):
    items = [stamped(m, START) if m.topic == LEFT else m for m in messages(drive())]
    assert f'{LEFT}: 99 of 100 messages bear the stamp of another' in told_of(tmp_path, items)


def test_a_bag_without_odometry_lists_what_it_holds(tmp_path):
    forces = [item for item in messages(drive()) if item.topic != ODOM]
    text = told_of(tmp_path, forces)
    assert 'no odometry. Name the topics with --odom. ' in text
    assert f'The bag holds {LEFT} (geometry_msgs/msg/WrenchStamped), {RIGHT} (' in text


def test_a_bag_without_forces_names_the_options(tmp_path):
    text = told_of(tmp_path, [item for item in messages(drive()) if item.topic == ODOM])
    assert 'no force of the left wheel and no force of the right wheel' in text
    assert '--left-force, --right-force' in text


def test_several_robots_are_listed(tmp_path):
    text = told_of(tmp_path, messages(drive(), '/ant') + messages(drive(), '/bee'))
    assert 'several robots: /ant, /bee. ' in text
    assert '--left-force, --right-force and --odom' in text


def test_a_topic_of_another_type_is_refused(tmp_path):
    wrong = [
        item._replace(content=twist(item.stamp, 1.0, 0.0)) if item.topic == LEFT else item
        for item in messages(drive())
    ]
    assert f'{LEFT} holds geometry_msgs/msg/TwistStamped; the force' in told_of(tmp_path, wrong)


def test_a_named_topic_that_is_not_there_is_told(tmp_path):
    write_run(tmp_path / 'drive', drive())
    text = told(tmp_path / 'drive', Topics(odom='odometry/filtered'))
    assert 'no messages on /odometry/filtered. The bag holds ' in text


def test_one_topic_for_both_wheels_is_refused(tmp_path):
    write_run(tmp_path / 'drive', drive())
    assert f'{LEFT} is given for both wheels' in told(tmp_path / 'drive', Topics(right_force=LEFT))


def test_a_folder_of_bags_is_no_bag(tmp_path):
    for name in ('first', 'second'):
        write_run(tmp_path / name, drive())
    assert 'a folder of bags. Give each: first, second' in told(tmp_path)


def test_short_recordings_are_refused(tmp_path):
    assert '16 odometry messages; at least 50' in told_of(tmp_path, messages(drive())[:50])


def test_clocks_that_differ_are_told(tmp_path):
    mixed = [
        stamped(item, item.stamp - START) if item.topic == ODOM else item
        for item in messages(drive())
    ]
    assert 'forces and odometry do not overlap in time' in told_of(tmp_path, mixed)


def test_a_clock_that_was_reset_is_told(tmp_path):
    again = [
        stamped(item._replace(stamp=item.stamp + 2 * 10**10), item.stamp - 10**10)
        for item in messages(drive())
    ]
    assert 'its clock jumps by -10.99 s' in told_of(tmp_path, messages(drive()) + again)


def test_what_is_no_bag_is_refused(tmp_path):
    (tmp_path / 'notes.txt').write_text('words')
    (tmp_path / 'words.mcap').write_text('words')
    (tmp_path / 'words.db3').write_text('words')
    assert 'there is no such bag' in told(tmp_path / 'nothing')
    assert 'not a bag. A bag is a folder' in told(tmp_path / 'notes.txt')
    assert 'damaged, or cut off' in told(tmp_path / 'words.mcap')
    assert 'damaged, or cut off' in told(tmp_path / 'words.db3')


def test_a_folder_without_metadata_was_cut_off(tmp_path):
    write_run(tmp_path / 'drive', drive())
    (tmp_path / 'drive' / 'metadata.yaml').unlink()
    assert 'no metadata.yaml: the recording was cut off' in told(tmp_path / 'drive')


@pytest.mark.parametrize('share', [0.0, 0.001, 0.5, 0.99])
def test_a_file_cut_off_anywhere_is_told(tmp_path, share):
    write_run(tmp_path / 'drive', drive())
    file = tmp_path / 'drive' / 'drive.mcap'
    file.write_bytes(file.read_bytes()[: int(share * file.stat().st_size)])
    assert 'damaged, or cut off' in told(tmp_path / 'drive')


def test_a_bag_of_a_later_version_is_not_called_damaged(tmp_path):
    write_run(tmp_path / 'drive', drive(), START)
    metadata = tmp_path / 'drive' / METADATA
    metadata.write_text(re.sub(r'version: \d+', 'version: 99', metadata.read_text()))
    assert 'of a kind that rosbags cannot read (Rosbag2 version 99' in told(tmp_path / 'drive')


def test_messages_that_metadata_alone_tells_of_are_missed(tmp_path):
    write_run(tmp_path / 'drive', drive())
    metadata = tmp_path / 'drive' / 'metadata.yaml'
    metadata.write_text(
        metadata.read_text().replace('durability: volatile', 'durability: transient_local')
    )
    assert 'tells of messages that its files do not give' in told(tmp_path / 'drive')
