"""Files of recordings that were cut off: what can be read goes into a file that is whole."""

import sqlite3
from collections.abc import Iterator
from contextlib import closing, suppress
from io import SEEK_END, BufferedReader, BytesIO, FileIO
from pathlib import Path
from shutil import copyfile

from mcap.opcode import Opcode
from mcap.records import Channel, Chunk, McapRecord, Message, Schema
from mcap.stream_reader import StreamReader, breakup_chunk
from mcap.writer import CompressionType, Writer

# Where the records of a chunk begin, and the length of its compression's name.
CHUNK_HEAD, COMPRESSION = 49, slice(37, 41)
BESIDE = ('-wal', '-journal')  # ends of the names of what SQLite has not yet put into a file


def mend(file: Path, copy: Path) -> None:
    """Copy the messages of an .mcap or .db3 file up to the cut."""
    mend_one = _mend_mcap if file.suffix == '.mcap' else _mend_sqlite3
    mend_one(file, copy)


def _mend_mcap(file: Path, copy: Path) -> None:
    schemas: dict[int, int] = {}
    channels: dict[int, int] = {}
    with copy.open('wb') as target:
        writer = Writer(target, compression=CompressionType.NONE)
        writer.start('ros2')
        for record in _records(file):
            if isinstance(record, Schema) and record.id not in schemas:
                schemas[record.id] = writer.register_schema(
                    record.name, record.encoding, record.data
                )
            elif isinstance(record, Channel) and record.id not in channels:
                kind = schemas.get(record.schema_id, 0)
                channels[record.id] = writer.register_channel(
                    record.topic, record.message_encoding, kind, record.metadata
                )
            elif isinstance(record, Message) and record.channel_id in channels:
                channel = channels[record.channel_id]
                writer.add_message(channel, record.log_time, record.data, record.publish_time)
        writer.finish()  # type: ignore[no-untyped-call]


def _records(file: Path) -> Iterator[McapRecord]:
    """Read from the front, without index, up to the cut or the first damage."""
    size, begin = file.stat().st_size, 0
    raw = FileIO(file)
    with _Strict(raw) as stream, suppress(Exception):  # damage surfaces as any error
        try:
            for record in StreamReader(stream, emit_chunks=True, record_size_limit=size).records:
                yield from _opened(record)
                begin = stream.tell()
        except EOFError:
            raw.seek(begin)
            yield from _of_cut_chunk(raw.readall())


def _opened(record: McapRecord) -> list[McapRecord]:
    return breakup_chunk(record, True) if isinstance(record, Chunk) else [record]


def _of_cut_chunk(rest: bytes) -> Iterator[McapRecord]:
    """Read what a chunk holds up to the cut; nothing where it was compressed."""
    if rest[:1] == bytes([Opcode.CHUNK]) and not any(rest[COMPRESSION]):
        inside = _Strict(BytesIO(rest[CHUNK_HEAD:]))
        yield from StreamReader(inside, skip_magic=True).records


class _Strict(BufferedReader):
    """Ends at the cut; mcap's own reader would return half a message."""

    def read(self, size: int | None = -1) -> bytes:
        data = super().read(size)
        if len(data) < (size or 0):
            raise EOFError
        return data


def _mend_sqlite3(file: Path, copy: Path) -> None:
    torn = copy.with_suffix('.torn')
    for end in ('', *BESIDE):  # opening a database may change it, so never open the only one
        with suppress(FileNotFoundError):
            copyfile(f'{file}{end}', f'{torn}{end}')
    _drop_half_page(torn)
    with closing(sqlite3.connect(torn)) as old, closing(sqlite3.connect(copy)) as new:
        with suppress(sqlite3.Error):
            old.execute('PRAGMA writable_schema = ON')  # opens a file that lacks its last pages
            tables = old.execute("SELECT name, sql FROM sqlite_master WHERE type = 'table'")
            for name, definition in tables.fetchall():
                new.execute(definition)
                _copy_rows(old, new, name)
        new.commit()


def _drop_half_page(database: Path) -> None:
    """Cut off a page that is not all there: SQLite would take what it lacks for zeros."""
    with database.open('r+b') as file:
        page = int.from_bytes(file.read(18)[16:], 'big')
        page = 2**16 if page == 1 else page  # which does not fit into two bytes
        size = file.seek(0, SEEK_END)
        file.truncate(size - size % max(page, 1))


def _copy_rows(old: sqlite3.Connection, new: sqlite3.Connection, table: str) -> None:
    """Copy rows up to the first that cannot be read."""
    with suppress(sqlite3.Error):
        for row in old.execute(f'SELECT * FROM {table} ORDER BY rowid'):
            new.execute(f'INSERT INTO {table} VALUES ({", ".join("?" * len(row))})', row)
