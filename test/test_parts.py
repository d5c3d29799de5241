"""A recording in parts: one bag of several files."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from resource import RLIMIT_FSIZE, getrlimit, setrlimit

import numpy as np
import pytest
import yaml
from drives import START, drive, messages
from rosbags.rosbag2 import Reader

from diffbot_sim.bags import read_run
from diffbot_sim.bags.messages import STORE
from diffbot_sim.bags.parts import Limits, PartsWriter
from diffbot_sim.bags.raw import Offer, Raw, raw_messages
from diffbot_sim.bags.recover import recover
from diffbot_sim.errors import BagError

CONTENT = [
    Raw(item.stamp, item.topic, kind, bytes(STORE.serialize_cdr(item.content, kind)))
    for item in messages(drive())
    for kind in [item.content.__msgtype__]
]


def recorded(folder: Path, limits: Limits, storage: str = 'mcap') -> Path:
    writer = PartsWriter(folder, storage, limits)
    for message in CONTENT:
        writer.write(message)
    writer.close()
    return folder


def flushed(folder: Path) -> None:
    """Record, each message handed to the operating system at once."""
    writer = PartsWriter(folder, 'mcap', Limits(duration=60.0))
    for message in CONTENT:
        writer.write(message)
        writer.flush()


@contextmanager
def files_no_larger_than(size: int) -> Iterator[None]:
    """Let the system refuse what a file has beyond a size [bytes], as a full disk would."""
    old = getrlimit(RLIMIT_FSIZE)
    setrlimit(RLIMIT_FSIZE, (size, old[1]))
    try:
        yield
    finally:
        setrlimit(RLIMIT_FSIZE, old)


def metadata(bag: Path) -> dict:
    text = (bag / 'metadata.yaml').read_text()
    return yaml.safe_load(text)['rosbag2_bagfile_information']


@pytest.mark.parametrize(('storage', 'end'), [('mcap', 'mcap'), ('sqlite3', 'db3')])
def test_parts_are_numbered_files_of_one_folder(tmp_path, storage, end):
    bag = recorded(tmp_path / 'drive', Limits(duration=0.3), storage)
    names = [f'drive_{number}.{end}' for number in range(4)]
    assert sorted(file.name for file in bag.iterdir()) == [*names, 'metadata.yaml']
    assert metadata(bag)['relative_file_paths'] == names
    assert metadata(bag)['storage_identifier'] == storage


@pytest.mark.parametrize('storage', ['mcap', 'sqlite3'])
def test_a_bag_in_parts_reads_like_any_other(tmp_path, storage):
    bag = recorded(tmp_path / 'drive', Limits(duration=0.3), storage)
    topics = {message.topic for message in CONTENT}
    assert [item._replace(data=bytes(item.data)) for item in raw_messages(bag, topics)] == CONTENT
    np.testing.assert_array_equal(read_run(bag).run.odometry.twist, drive().odometry.twist)


def test_the_metadata_tell_of_each_file_and_of_all(tmp_path):
    about = metadata(recorded(tmp_path / 'drive', Limits(duration=0.3)))
    assert about['message_count'] == sum(f['message_count'] for f in about['files']) == 300
    assert about['starting_time']['nanoseconds_since_epoch'] == START
    assert about['duration']['nanoseconds'] == CONTENT[-1].stamp - START
    assert about['files'][1]['starting_time']['nanoseconds_since_epoch'] == START + 310_000_000
    counts = {t['topic_metadata']['name']: t['message_count'] for t in about[TOPICS]}
    assert counts == {'/odom': 100, '/left_wheel/force': 100, '/right_wheel/force': 100}


TOPICS = 'topics_with_message_count'


def test_a_part_is_about_as_big_as_was_asked(tmp_path):
    bag = recorded(tmp_path / 'drive', Limits(size=40_000))
    sizes = [file.stat().st_size for file in sorted(bag.glob('*.mcap'))]
    assert len(sizes) > 2
    assert all(30_000 < size < 60_000 for size in sizes[:-1])


def test_each_finished_part_is_on_disk_while_the_next_is_written(tmp_path):
    writer = PartsWriter(tmp_path / 'drive', 'mcap', Limits(duration=0.3))
    for message in CONTENT:
        writer.write(message)
    with Reader(tmp_path / 'drive' / 'drive_0.mcap') as reader:
        assert reader.message_count == 93
    writer.close()


def test_an_offer_that_changes_later_leaves_a_topic_one_topic(tmp_path):
    writer = PartsWriter(tmp_path / 'drive', 'mcap', Limits(duration=0.3))
    for number, message in enumerate(CONTENT):
        writer.write(message, Offer('reliable' if number < 150 else 'best_effort'))
    writer.close()
    assert len(metadata(tmp_path / 'drive')[TOPICS]) == 3


def test_an_empty_recording_is_a_bag(tmp_path):
    PartsWriter(tmp_path / 'drive', 'mcap', Limits(duration=1.0)).close()
    with Reader(tmp_path / 'drive') as reader:
        assert reader.message_count == 0


def test_a_folder_that_exists_is_refused(tmp_path):
    with pytest.raises(BagError, match='exists already'):
        PartsWriter(tmp_path, 'mcap', Limits(duration=1.0))


def test_a_bag_that_cannot_grow_is_told_by_name_and_what_it_holds_is_kept(tmp_path):
    full = rf'{tmp_path}/drive/drive_0: cannot be written on: File too large. Save what'
    with files_no_larger_than(20_000), pytest.raises(BagError, match=full):
        flushed(tmp_path / 'drive')
    saved = recover(tmp_path / 'drive', tmp_path / 'saved').saved
    assert 0 < saved['/odom'].count < 100
