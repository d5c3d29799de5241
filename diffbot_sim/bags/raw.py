"""Serialized messages out of bags, as they are: nothing here looks inside them."""

from collections.abc import Collection, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

from rosbags.interfaces import QosDurability

from diffbot_sim.bags import storage
from diffbot_sim.bags.messages import STORE
from diffbot_sim.bags.topics import absolute


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


USUAL = Offer()


def is_standard(kind: str) -> bool:
    """Say whether the definition of a message type is known, so that it can be recorded."""
    return kind in STORE.types


def topics_in(bag: Path) -> dict[str, str]:
    """Return the types of all topics that hold messages, by full name; raises BagError."""
    with _opened(bag) as reader:
        return storage.types_in(reader)


def kept_topics(bag: Path) -> set[str]:
    """Return the full names of topics whose messages wait for late listeners; raises BagError."""
    with _opened(bag) as reader:
        return {absolute(item.topic) for item in reader.connections if _is_kept(item)}


def span_of(bag: Path) -> tuple[int, int]:
    """Return when the first and the last message of a bag came [ns]; raises BagError."""
    with _opened(bag) as reader:
        return reader.start_time, reader.end_time - 1


def raw_messages(bag: Path, topics: Collection[str], start: int = 0) -> Iterator[Raw]:
    """Read the messages of some topics from a moment [ns] on, as received; raises BagError."""
    with _opened(bag) as reader:
        sources = [item for item in reader.connections if absolute(item.topic) in topics]
        for source, stamp, data in reader.messages(sources, start) if sources else ():
            yield Raw(stamp, absolute(source.topic), source.msgtype, data)


@contextmanager
def _opened(bag: Path) -> Iterator[Any]:
    with storage.naming(bag):
        storage.check_place(bag)
        with storage.opened(bag) as reader:
            yield reader


def _is_kept(source: Any) -> bool:
    offers = source.ext.offered_qos_profiles
    return any(offer.durability is QosDurability.TRANSIENT_LOCAL for offer in offers)
