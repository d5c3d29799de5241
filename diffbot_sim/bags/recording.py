"""Serialized messages into a new bag, one file of it, as they come."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from sqlite3 import Error as SqliteError
from typing import Any

from rosbags.interfaces import QosDurability, QosHistory, QosReliability
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.rosbag2.errors import WriterError

from diffbot_sim.bags.folder import QUALITY
from diffbot_sim.bags.messages import STORE
from diffbot_sim.bags.raw import USUAL, Offer, Raw
from diffbot_sim.bags.storage import MEND
from diffbot_sim.errors import BagError

MCAP = 'mcap'


class RawWriter:
    """Writes a new bag of one file; close() makes it readable, so it must be called.

    Raises BagError when the folder exists or cannot be made, and each time the disk is full.
    """

    def __init__(self, folder: Path, storage: str = MCAP) -> None:
        self._folder = folder
        self._connections: dict[tuple[str, str], Any] = {}
        self._flush = _flush_mcap if storage == MCAP else _flush_sqlite3
        try:
            self._writer = Writer(folder, version=9, storage_plugin=StoragePlugin[storage.upper()])
            self._writer.open()
        except WriterError as error:
            raise BagError(f'{folder}: exists already. Choose another folder.') from error
        except (OSError, SqliteError) as error:
            raise BagError(f'{folder}: cannot be written: {_reason(error)}.') from error

    def write(self, message: Raw, offer: Offer = USUAL) -> None:
        """Add a message; the first of a topic says what its publisher offers."""
        key = message.topic, message.kind
        with self._telling():
            if key not in self._connections:
                self._connections[key] = self._connect(*key, offer)
            self._writer.write(self._connections[key], message.stamp, message.data)

    def flush(self) -> None:
        """Hand all messages to the operating system: they outlive this process."""
        with self._telling():
            self._flush(self._writer.storage)

    def close(self) -> None:
        """Write index and metadata."""
        with self._telling():
            self._writer.close()

    @contextmanager
    def _telling(self) -> Iterator[None]:
        """Tell what keeps the bag from growing, and that what it holds is not lost."""
        try:
            yield
        except (OSError, SqliteError) as error:
            told = f'{self._folder}: cannot be written on: {_reason(error)}. {MEND}'
            raise BagError(told) from error

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


def _reason(error: OSError | SqliteError) -> str:
    return str(getattr(error, 'strerror', error))


def _flush_mcap(storage: Any) -> None:
    if storage.chunk.msgs:
        storage.close_chunk()
    storage.bio.flush()


def _flush_sqlite3(storage: Any) -> None:
    storage.conn.commit()
