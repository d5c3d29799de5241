"""Files: their names as text, and what is written whole or not at all."""

from os import PathLike, fsencode
from pathlib import Path


def spelled(path: str | PathLike[str]) -> str:
    """Return a path in characters that any file may hold: bytes that are no UTF-8 are replaced."""
    return fsencode(path).decode('utf-8', 'replace')


def write_whole(path: Path, text: str) -> None:
    """Write a file of which a reader finds the old text or the new one, never half of one.

    Raises OSError when it cannot be written; nothing is left of it then.
    """
    part = path.with_name(f'{path.name}.part')
    try:
        part.write_text(text, 'utf-8')
        part.replace(path)
    except OSError:
        part.unlink(missing_ok=True)
        raise
