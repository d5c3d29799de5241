"""A bag whose recording was cut off to a good one with all that can be read."""

import re
from collections.abc import Iterable, Iterator, Mapping
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

from diffbot_sim.bags.folder import whole_or_not_at_all
from diffbot_sim.bags.mending import BESIDE, mend
from diffbot_sim.bags.messages import STORE
from diffbot_sim.bags.series import NANOSECONDS
from diffbot_sim.bags.storage import FORM, STORAGE, opened
from diffbot_sim.errors import BagError


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


@dataclass(frozen=True)
class Recovery:
    """What was saved, by topic; which topics had to be left out, for want of a definition."""

    was_whole: bool
    saved: Mapping[str, Saved]
    left_out: tuple[str, ...] = ()


def recover(bag: Path, out: Path) -> Recovery:
    """Write all that can be read of a bag (folder or file) to a new bag; the old one is kept.

    Raises BagError when nothing can be read, or out holds a recorded bag.
    """
    files, was_whole = _files(bag), is_whole(bag)
    with whole_or_not_at_all(out) as place:
        sources = [bag] if was_whole else _mended(files, place.parent)
        saved, left_out = _copy(sources, place)
        if not saved:
            raise BagError(f'{bag}: no message in it can be read. Record it again.')
    return Recovery(was_whole, saved, left_out)


def is_whole(bag: Path) -> bool:
    """Say whether a bag, or one of its files, can be read to the end."""
    if any(Path(f'{bag}{end}').exists() for end in BESIDE):
        return False
    try:
        with opened(bag) as reader:
            return sum(1 for _ in reader.messages()) == int(reader.message_count)
    except BagError:
        return False


def _files(bag: Path) -> list[Path]:
    """List the storage files of a bag, the second part before the tenth."""
    if not bag.exists():
        raise BagError(f'{bag}: there is no such bag.')
    found = [bag] if bag.is_file() else [file for file in bag.rglob('*') if file.is_file()]
    files = [file for file in found if file.suffix in STORAGE]
    if not files:
        raise BagError(f'{bag}: not a bag. {FORM}')
    return sorted(files, key=lambda file: [int(n) for n in re.findall(r'\d+', file.stem)])


def _mended(files: Iterable[Path], workplace: Path) -> Iterator[Path]:
    """Return the files, a mended copy in place of each that is cut; none where nothing is left."""
    for number, file in enumerate(files):
        copy = workplace / f'mended_{number}{file.suffix}'
        if is_whole(file):
            yield file
            continue
        mend(file, copy)
        if is_whole(copy):
            yield copy


def _copy(sources: Iterable[Path], place: Path) -> tuple[dict[str, Saved], tuple[str, ...]]:
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
    with suppress(TypesysError):
        is_idl = source.msgdef.format == MessageDefinitionFormat.IDL
        store = get_typestore(Stores.EMPTY)
        store.register(get_types_from_idl(text) if is_idl else get_types_from_msg(text, kind))
        yield store
    yield STORE
