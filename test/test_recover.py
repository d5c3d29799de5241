"""`recover`: everything up to the cut comes back, whatever was cut."""

import sqlite3
from collections.abc import Callable
from contextlib import closing
from pathlib import Path
from shutil import copytree

import pytest
from drives import START, drive, messages
from rosbags.rosbag2 import Reader, StoragePlugin, Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from zstandard import ZstdCompressor

from diffbot_sim.__main__ import main
from diffbot_sim.bags import read_run, write_run
from diffbot_sim.bags.messages import STORE
from diffbot_sim.bags.parts import Limits, PartsWriter
from diffbot_sim.bags.raw import USUAL, Offer, Raw
from diffbot_sim.bags.recording import RawWriter
from diffbot_sim.bags.recover import recover
from diffbot_sim.errors import BagError

CONTENT = [
    Raw(item.stamp, item.topic, kind, bytes(STORE.serialize_cdr(item.content, kind)))
    for item in messages(drive())
    for kind in [item.content.__msgtype__]
]


def abandoned(folder: Path, storage: str, offer: Offer = USUAL) -> Path:
    """Record a drive, and leave it as a killed recorder does."""
    writer = RawWriter(folder, storage)
    for number, message in enumerate(CONTENT):
        writer.write(message, offer)
        if number % 50 == 49:
            writer.flush()
    writer._writer.abort()
    return folder


def held(bag: Path) -> list[tuple[int, str, bytes]]:
    with Reader(bag) as reader:
        return [(stamp, item.topic, bytes(data)) for item, stamp, data in reader.messages()]


def refused(act: Callable[[], object]) -> str:
    with pytest.raises(BagError) as caught:
        act()
    return str(caught.value)


@pytest.mark.parametrize('storage', ['mcap', 'sqlite3'])
def test_all_that_was_flushed_comes_back(tmp_path, storage):
    bag = abandoned(tmp_path / 'cut', storage, Offer('best_effort'))
    recovery = recover(bag, tmp_path / 'whole')
    assert held(tmp_path / 'whole') == [(m.stamp, m.topic, m.data) for m in CONTENT]
    assert recovery.saved['/odom'].count == 100
    assert recovery.saved['/odom'].seconds == pytest.approx(0.99)
    with Reader(tmp_path / 'whole') as reader:
        (quality,) = reader.connections[0].ext.offered_qos_profiles
    assert quality.reliability.name == 'BEST_EFFORT'


@pytest.mark.parametrize('share', [0.5, 0.67, 0.8, 0.99])
@pytest.mark.parametrize('storage', ['mcap', 'sqlite3'])
def test_a_file_cut_anywhere_gives_all_before_the_cut(tmp_path, storage, share):
    (file,) = abandoned(tmp_path / 'cut', storage).iterdir()
    file.write_bytes(file.read_bytes()[: int(share * file.stat().st_size)])
    recover(file, tmp_path / 'whole')
    found = held(tmp_path / 'whole')
    assert found == [(m.stamp, m.topic, m.data) for m in CONTENT][: len(found)]
    assert len(found) > 0.9 * share * len(CONTENT) - 20


def test_what_sqlite_had_not_yet_put_into_the_file_comes_back_too(tmp_path):
    writer = RawWriter(tmp_path / 'live', 'sqlite3')
    writer._writer.storage.conn.execute('PRAGMA journal_mode = WAL')
    for message in CONTENT:
        writer.write(message)
    writer.flush()
    copytree(tmp_path / 'live', tmp_path / 'cut')
    writer.close()
    recover(tmp_path / 'cut', tmp_path / 'whole')
    assert len(held(tmp_path / 'whole')) == len(CONTENT)


@pytest.mark.parametrize('packed', [False, True])
def test_finished_parts_and_the_one_that_was_cut_off_are_put_together(tmp_path, packed):
    writer = PartsWriter(tmp_path / 'cut', 'mcap', Limits(duration=0.3))
    for message in CONTENT:
        writer.write(message)
    writer.flush()
    if packed:  # as `ros2 bag record --compression-mode file` leaves them
        first = min((tmp_path / 'cut').iterdir())
        first.with_name(f'{first.name}.zstd').write_bytes(
            ZstdCompressor().compress(first.read_bytes())
        )
        first.unlink()
    assert 'diffbot_sim recover' in refused(lambda: read_run(tmp_path / 'cut'))
    recover(tmp_path / 'cut', tmp_path / 'whole')
    assert held(tmp_path / 'whole') == [(m.stamp, m.topic, m.data) for m in CONTENT]


def test_the_command_tells_what_was_saved_of_each_topic(tmp_path, capsys):
    bag, out = abandoned(tmp_path / 'cut', 'mcap'), tmp_path / 'whole'
    assert main(['recover', str(bag), '--out', str(out)]) == 0
    first, *_, last = capsys.readouterr().out.splitlines()
    assert first.split() == ['/left_wheel/force', '100', 'messages', '1.0', 's']
    assert last == f'bag: {out}'


def test_a_whole_bag_is_copied_with_a_word(tmp_path, capsys):
    write_run(tmp_path / 'drive', drive(), START)
    assert main(['recover', str(tmp_path / 'drive'), '--out', str(tmp_path / 'copy')]) == 0
    assert 'nothing was wrong' in capsys.readouterr().out
    assert held(tmp_path / 'copy') == held(tmp_path / 'drive')


def test_a_recovered_bag_counts_as_recorded_and_is_kept(tmp_path):
    bag = abandoned(tmp_path / 'cut', 'mcap')
    recover(bag, tmp_path / 'whole')
    assert 'holds a recorded bag' in refused(lambda: recover(bag, tmp_path / 'whole'))


def test_a_recording_that_was_cut_off_is_not_written_over(tmp_path):
    bag = abandoned(tmp_path / 'cut', 'mcap')
    assert 'which is kept' in refused(lambda: write_run(bag, drive(), START))


def test_what_cannot_be_recovered_is_told(tmp_path):
    (tmp_path / 'words.mcap').write_text('words')
    (tmp_path / 'words.db3').write_text('words')
    out = tmp_path / 'out'
    assert 'no message in it' in refused(lambda: recover(tmp_path / 'words.mcap', out))
    assert 'no message in it' in refused(lambda: recover(tmp_path / 'words.db3', out))
    assert 'there is no such bag' in refused(lambda: recover(tmp_path / 'none', out))
    assert 'not a bag' in refused(lambda: recover(Path(__file__), out))


def test_definitions_that_are_missing_are_those_of_ros(tmp_path):
    (file,) = abandoned(tmp_path / 'cut', 'sqlite3').iterdir()
    with closing(sqlite3.connect(file)) as old:
        old.execute('DELETE FROM message_definitions')
        old.execute("UPDATE topics SET type = 'tank_msgs/msg/Level' WHERE name = '/odom'")
        old.commit()
    recovery = recover(file, tmp_path / 'whole')
    assert recovery.left_out == ('/odom (tank_msgs/msg/Level)',)
    with Reader(tmp_path / 'whole') as reader:
        assert 'Wrench wrench' in reader.connections[0].msgdef.data


def test_a_type_that_is_not_of_ros_comes_back_by_the_definition_in_the_bag(tmp_path):
    with Writer(tmp_path / 'own', version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        own = get_types_from_msg('float64 level', 'tank_msgs/msg/Level')
        store = get_typestore(Stores.EMPTY)
        store.register(own)
        topic = writer.add_connection('/level', 'tank_msgs/msg/Level', typestore=store)
        writer.write(topic, 1, bytes(12))
    (tmp_path / 'own' / 'metadata.yaml').unlink()
    recover(tmp_path / 'own', tmp_path / 'whole')
    with Reader(tmp_path / 'whole') as reader:
        assert reader.connections[0].msgdef.data.startswith('float64 level')
        assert reader.connections[0].digest == store.hash_rihs01('tank_msgs/msg/Level')
