"""Messages of several files to one bag, as they are."""

from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rosbags.interfaces import MessageDefinitionFormat
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import (
    Stores,
    TypesysError,
    get_types_from_idl,
    get_types_from_msg,
    get_typestore,
)

from diffbot_sim.bags.messages import STORE
from diffbot_sim.bags.storage import opened
from diffbot_sim.records import NANOSECONDS


@dataclass(frozen=True)
class Saved:
    """The messages of one topic that could be read, and their first and last stamp [ns]."""

    count: int
    first: int
    last: int

    @property
    def seconds(self) -> float:
        """The time from the first to the last message [s]."""
        return (self.last - self.first) / NANOSECONDS

    def __add__(self, other: 'Saved') -> 'Saved':
        first, last = min(self.first, other.first), max(self.last, other.last)
        return Saved(self.count + other.count, first, last)


def copy_messages(
    sources: Iterable[Path], place: Path
) -> tuple[dict[str, Saved], tuple[str, ...]]:
    """Write the messages of several files to one bag; tell what was saved and left out."""
    saved: dict[str, Saved] = {}
    targets: dict[tuple[str, str], Any] = {}
    with Writer(place, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        for source, stamp, data in _messages(sources):
            key = source.topic, source.msgtype
            if key not in targets:
                targets[key] = _target(writer, source)
            if targets[key]:
                writer.write(targets[key], stamp, data)
                one = Saved(1, stamp, stamp)
                saved[source.topic] = saved[source.topic] + one if source.topic in saved else one
    return saved, tuple(f'{topic} ({kind})' for (topic, kind), to in targets.items() if not to)


def _messages(sources: Iterable[Path]) -> Iterator[tuple[Any, int, bytes]]:
    for source in sources:
        with opened(source) as reader:
            yield from reader.messages()


def _target(writer: Any, source: Any) -> Any:
    """Declare a topic as the old bag did; None where nobody knows the definition of its type."""
    for store in _type_stores(source):
        with suppress(TypesysError, KeyError):
            return writer.add_connection(
                source.topic,
                source.msgtype,
                typestore=store,
                serialization_format=source.ext.serialization_format,
                offered_qos_profiles=source.ext.offered_qos_profiles,
            )
    return None


def _type_stores(source: Any) -> Iterator[Any]:
    """Offer the types that the bag itself defines, then those of ROS."""
    text, kind = source.msgdef.data, source.msgtype
    if text:  # older recorders wrote none
        with suppress(TypesysError):
            is_idl = source.msgdef.format == MessageDefinitionFormat.IDL
            store = get_typestore(Stores.EMPTY)
            store.register(get_types_from_idl(text) if is_idl else get_types_from_msg(text, kind))
            yield store
    yield STORE
