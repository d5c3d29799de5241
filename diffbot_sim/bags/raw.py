"""Serialized messages into and out of bags, as they are: nothing here looks inside them."""

from collections.abc import Collection, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

from rosbags.interfaces import QosDurability, QosHistory, QosReliability
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.rosbag2.errors import WriterError

from diffbot_sim.bags import storage
from diffbot_sim.bags.folder import QUALITY
from diffbot_sim.bags.messages import STORE
from diffbot_sim.errors import BagError


class Raw(NamedTuple):
    """One message as it went over the wire: when it was received [ns], and where."""

    stamp: int
    topic: str
    kind: str
    data: bytes


@dataclass(frozen=True)
class Offer:
    """Quality of service that a topic's publisher offers, in the words of ROS."""

    reliability: str = 'reliable'
    durability: str = 'volatile'
    history: str = 'keep_last'
    depth: int = 10


def is_standard(kind: str) -> bool:
    """Say whether the definition of a message type is known, so that it can be recorded."""
    return kind in STORE.types


class RawWriter:
    """Writes a new bag; close() makes it readable, so it must be called.

    Raises BagError when the folder exists or cannot be made.
    """

    def __init__(self, folder: Path) -> None:
        self._connections: dict[tuple[str, str], Any] = {}
        try:
            self._writer = Writer(folder, version=9, storage_plugin=StoragePlugin.MCAP)
            self._writer.open()
        except WriterError as error:
            raise BagError(f'{folder}: exists already. Choose another folder.') from error
        except OSError as error:
            raise BagError(f'{folder}: cannot be written: {error.strerror}.') from error

    def write(self, message: Raw, offer: Offer = Offer()) -> None:
        """Add a message; the first of a topic says what its publisher offers."""
        key = message.topic, message.kind
        if key not in self._connections:
            self._connections[key] = self._connect(*key, offer)
        self._writer.write(self._connections[key], message.stamp, message.data)

    def close(self) -> None:
        """Write index and metadata."""
        self._writer.close()

    def _connect(self, topic: str, kind: str, offer: Offer) -> Any:
        quality = QUALITY._replace(
            reliability=QosReliability[offer.reliability.upper()],
            durability=QosDurability[offer.durability.upper()],
            history=QosHistory[offer.history.upper()],
            depth=offer.depth,
        )
        return self._writer.add_connection(
            topic, kind, typestore=STORE, offered_qos_profiles=[quality]
        )


def topics_in(bag: Path) -> dict[str, str]:
    """Return the types of all topics that hold messages, by name; raises BagError."""
    with _opened(bag) as reader:
        return {item.topic: item.msgtype for item in reader.connections if item.msgcount}


def raw_messages(bag: Path, topics: Collection[str]) -> Iterator[Raw]:
    """Read the messages of some topics in the order of their receipt; raises BagError."""
    with _opened(bag) as reader:
        sources = [item for item in reader.connections if item.topic in topics]
        for source, stamp, data in reader.messages(sources) if sources else ():
            yield Raw(stamp, source.topic, source.msgtype, data)


@contextmanager
def _opened(bag: Path) -> Iterator[Any]:
    try:
        storage._check_place(bag)
        with storage._opened(bag) as reader:
            yield reader
    except BagError as error:
        raise BagError(f'{bag}: {error}') from error
