"""Opens bags and tells what is wrong with those that cannot be read."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from rosbags.rosbag2 import Reader

from diffbot_sim.bags.folder import METADATA, STORAGE, is_part
from diffbot_sim.bags.messages import STORE, odometry_row, wrench_row
from diffbot_sim.bags.series import Series
from diffbot_sim.bags.topics import Topics, absolute, find_topics
from diffbot_sim.errors import BagError
from diffbot_sim.records import NANOSECONDS

FORM = 'A bag is a folder that holds metadata.yaml, or one .mcap or .db3 file.'
MEND = "Save what can be read with 'diffbot_sim recover BAG --out DIR'."
ROWS = {'left_force': wrench_row, 'right_force': wrench_row, 'odom': odometry_row}
# How many numbers of a row are a force, or a twist; the others of odometry are a place.
MEASURED = {'left_force': 1, 'right_force': 1, 'odom': 2}


def read_series(path: Path, topics: Topics) -> dict[str, Series]:
    """Return what the topics of left_force, right_force and odom hold; raises BagError."""
    check_place(path)
    with opened(path) as reader:
        chosen = find_topics(types_in(reader), topics)
        return {role: _read(reader, topic, role) for role, topic in chosen.items()}


def types_in(reader: Any) -> dict[str, str]:
    """Return the types of all topics that hold messages, by full name."""
    held = [item for item in reader.connections if item.msgcount]
    return {absolute(item.topic): item.msgtype for item in held}


def _read(reader: Any, topic: str, role: str) -> Series:
    sources = [item for item in reader.connections if absolute(item.topic) == topic]
    received, stamped, rows = [], [], []
    for source, time, data in reader.messages(sources):
        message: Any = STORE.deserialize_cdr(data, source.msgtype)
        stamp = message.header.stamp
        received.append(time)
        stamped.append(stamp.sec * NANOSECONDS + stamp.nanosec)
        rows.append(ROWS[role](message))
    if not rows:
        raise BagError(
            f'{topic}: {METADATA} tells of messages that its files do not give, as where its QoS '
            f'was edited. {MEND}'
        )
    values = np.array(rows, dtype=float)
    return Series(topic, np.array(received), np.array(stamped), values, MEASURED[role])


@contextmanager
def opened(path: Path) -> Iterator[Any]:
    """Open a bag, or one of its files, for reading; raises BagError where that cannot be done."""
    try:
        with Reader(path) as reader:
            yield reader
    except BagError:
        raise
    except PermissionError as error:
        raise BagError(f'cannot be read ({error.strerror}). Check its permissions.') from error
    except Exception as error:  # damaged bytes surface as any of struct's, sqlite's, zstd's errors
        detail = ' '.join(str(error).split()).rstrip('.') or type(error).__name__
        if 'not supported' in detail:
            raise BagError(f'of a kind that rosbags cannot read ({detail}).') from error
        raise BagError(f'damaged, or cut off while it was recorded ({detail}). {MEND}') from error


@contextmanager
def naming(bag: str | Path) -> Iterator[None]:
    """Put the name of a bag before what is wrong with it."""
    try:
        yield
    except BagError as error:
        raise BagError(f'{bag}: {error}') from error


def check_no_bags_below(path: Path) -> None:
    """Raise BagError where bags lie in folders below a path: which is meant has to be said."""
    bags = sorted(file.parent.name for file in path.glob(f'*/{METADATA}'))
    if bags:
        raise BagError(f'a folder of bags. Give each: {", ".join(bags)}.')


def check_place(path: Path) -> None:
    """Raise BagError when there is no bag at a path."""
    if not path.exists():
        raise BagError('there is no such bag.')
    if path.is_file() and path.suffix not in STORAGE:
        raise BagError(f'compressed. {MEND}' if is_part(path) else f'not a bag. {FORM}')
    if path.is_dir() and not (path / METADATA).exists():
        check_no_bags_below(path)
        if any(is_part(file) for file in path.rglob('*')):
            raise BagError(f'no metadata.yaml: the recording was cut off. {MEND}')
        raise BagError(f'not a bag. {FORM}')
