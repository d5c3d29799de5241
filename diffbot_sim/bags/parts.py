"""A recording in several files, as `ros2 bag record` splits it: NAME_0, NAME_1 and so on."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import inf
from pathlib import Path
from typing import Any

import yaml

from diffbot_sim.bags.folder import METADATA
from diffbot_sim.bags.raw import USUAL, Offer, Raw
from diffbot_sim.bags.recording import RawWriter
from diffbot_sim.errors import BagError
from diffbot_sim.files import write_whole
from diffbot_sim.records import NANOSECONDS

INFORMATION = 'rosbag2_bagfile_information'
FAR = 2**63 - 1  # [ns]
RECORD = 64  # bytes that a file needs for a message, beside its content


@dataclass(frozen=True)
class Limits:
    """When a part is full: size [bytes], duration [s]."""

    size: float = inf
    duration: float = inf


def recording(folder: Path, storage: str, limits: Limits) -> 'RawWriter | PartsWriter':
    """Begin a recording of one file, or of several where there are limits; raises BagError."""
    if limits == Limits():
        return RawWriter(folder, storage)
    return PartsWriter(folder, storage, limits)


class PartsWriter:
    """Writes a new bag in parts; a finished part stands in the folder, readable by itself.

    Raises BagError when the folder exists or cannot be made.
    """

    _size: int  # of the part [bytes]
    _since: int  # its first stamp [ns]

    def __init__(self, folder: Path, storage: str, limits: Limits) -> None:
        if folder.exists():
            raise BagError(f'{folder}: exists already. Choose another folder.')
        self._folder, self._storage, self._limits = folder, storage, limits
        self._offers: dict[tuple[str, str], Offer] = {}
        self._finished: list[dict[str, Any]] = []
        self._begin()

    def write(self, message: Raw, offer: Offer = USUAL) -> None:
        """Add a message; the first of a topic says what its publisher offers."""
        if self._is_full(message.stamp):
            self._finish()
            self._begin()
        first_offer = self._offers.setdefault((message.topic, message.kind), offer)
        self._part.write(message, first_offer)
        self._size += len(message.data) + RECORD
        self._since = min(self._since, message.stamp)

    def flush(self) -> None:
        """Hand all messages to the operating system: they outlive this process."""
        self._part.flush()

    def close(self) -> None:
        """Finish the last part and write the metadata of all."""
        self._finish()
        text = yaml.safe_dump({INFORMATION: joined(self._finished)})
        write_whole(self._folder / METADATA, text)

    def _is_full(self, stamp: int) -> bool:
        age = (stamp - self._since) / NANOSECONDS
        return self._size >= self._limits.size or age > self._limits.duration

    def _begin(self) -> None:
        """Start a part in a folder of its own, which is how the writer wants it."""
        self._place = self._folder / f'{self._folder.resolve().name}_{len(self._finished)}'
        self._part = RawWriter(self._place, self._storage)
        self._size, self._since = 0, FAR

    def _finish(self) -> None:
        """Close the part, keep its metadata and move its file beside the others."""
        self._part.close()
        metadata = self._place / METADATA
        part = yaml.safe_load(metadata.read_text('utf-8'))[INFORMATION]
        (name,) = part['relative_file_paths']
        (self._place / name).replace(self._folder / name)
        metadata.unlink()
        self._place.rmdir()
        self._finished.append(part)


def joined(parts: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Return the metadata of a bag from those of its parts."""
    files = [file for part in parts for file in part['files']]
    start = min(map(_start, files))
    end = max(_start(file) + file['duration']['nanoseconds'] for file in files)
    return {
        **parts[0],
        'relative_file_paths': [file['path'] for file in files],
        'files': files,
        'starting_time': {'nanoseconds_since_epoch': start},
        'duration': {'nanoseconds': end - start},
        'message_count': sum(part['message_count'] for part in parts),
        'topics_with_message_count': _counts(
            topic for part in parts for topic in part['topics_with_message_count']
        ),
    }


def _start(file: Mapping[str, Any]) -> int:
    return int(file['starting_time']['nanoseconds_since_epoch'])


def _counts(topics: Iterable[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """Add up the messages of each topic, in the order of their first ones."""
    counts: dict[str, dict[str, Any]] = {}
    for topic in topics:
        facts = topic['topic_metadata']
        same = counts.setdefault(
            f'{facts["name"]} {facts["type"]}', {'topic_metadata': facts, 'message_count': 0}
        )
        same['message_count'] += topic['message_count']
    return list(counts.values())
