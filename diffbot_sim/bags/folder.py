"""Writes the files of a bag into a folder without harming what else lies there."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from operator import attrgetter
from os import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

from rosbags.interfaces import (
    Qos,
    QosDurability,
    QosHistory,
    QosLiveliness,
    QosReliability,
    QosTime,
)
from rosbags.rosbag2 import StoragePlugin, Writer

from diffbot_sim.bags.messages import STORE
from diffbot_sim.errors import BagError

METADATA = 'metadata.yaml'
STORAGE, PACKED = ('.mcap', '.db3'), '.zstd'
# Written into metadata.yaml: a bag that has it may be replaced.
MARK = ('computed_by', 'diffbot_sim')
FOREVER = QosTime(9223372036, 854775807)
QUALITY = Qos(
    history=QosHistory.KEEP_LAST,
    depth=10,
    reliability=QosReliability.RELIABLE,
    durability=QosDurability.VOLATILE,
    deadline=FOREVER,
    lifespan=FOREVER,
    liveliness=QosLiveliness.AUTOMATIC,
    liveliness_lease_duration=FOREVER,
    avoid_ros_namespace_conventions=False,
)


class Message(NamedTuple):
    """One message: stamp [ns], topic, content."""

    stamp: int
    topic: str
    content: Any


def is_part(file: Path) -> bool:
    """Say whether a file is a part of a bag, compressed or not."""
    return (file.with_suffix('') if file.suffix == PACKED else file).suffix in STORAGE


def check_replaceable(folder: Path) -> None:
    """Raise BagError when the folder is a file, or holds a bag that was not computed here."""
    if folder.exists() and not folder.is_dir():
        raise BagError(f'{folder}: a file is in the way. Choose another place.')
    metadata = folder / METADATA
    if metadata.exists() and ': '.join(MARK) not in metadata.read_text('utf-8', 'replace'):
        raise BagError(f'{folder}: holds a recorded bag, which is kept. Choose another place.')
    if not metadata.exists() and any(is_part(file) for file in folder.rglob('*')):
        raise BagError(
            f'{folder}: holds a recording that was cut off, which is kept. Choose another place.'
        )


def write_bag(folder: Path, messages: Sequence[Message]) -> None:
    """Write a bag; one that was computed before is replaced, other files stay.

    Raises BagError when the folder holds a recorded bag or cannot be written.
    """
    with whole_or_not_at_all(folder) as place:
        _write(place, sorted(messages, key=attrgetter('stamp')))


@contextmanager
def whole_or_not_at_all(folder: Path) -> Iterator[Path]:
    """Offer a place for a new mcap bag, which moves into the folder once it is finished.

    Raises BagError when the folder holds a recorded bag or cannot be written.
    """
    check_replaceable(folder)
    target = folder.resolve()
    try:
        target.mkdir(parents=True, exist_ok=True)
        with TemporaryDirectory(dir=target, prefix='.unfinished-') as workplace:
            yield Path(workplace) / target.name
            # Last comes what makes the folder a bag.
            for name in (f'{target.name}.mcap', METADATA):
                replace(Path(workplace) / target.name / name, target / name)
    except OSError as error:
        raise BagError(f'{folder}: cannot be written: {error.strerror}.') from error


def _write(path: Path, messages: Sequence[Message]) -> None:
    with Writer(path, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        writer.set_custom_data(*MARK)
        kinds = {message.topic: message.content.__msgtype__ for message in messages}
        connections = {
            topic: writer.add_connection(
                topic, kind, typestore=STORE, offered_qos_profiles=[QUALITY]
            )
            for topic, kind in kinds.items()
        }
        for stamp, topic, content in messages:
            data = STORE.serialize_cdr(content, content.__msgtype__)
            writer.write(connections[topic], stamp, data)
