"""The folder of a data set, which appears as a whole or not at all."""

import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

from diffbot_sim.errors import DiffbotError
from diffbot_sim.tables.manifest import MANIFEST, has_manifest

TABLE = re.compile(r'run_\d{4,}\.[a-z]+')


def check_replaceable(folder: Path) -> None:
    """Raise DiffbotError unless the folder is new, empty, or holds an earlier data set."""
    if folder.exists() and not folder.is_dir():
        raise DiffbotError(f'{folder}: a file is in the way. Choose another folder for --out.')
    # What hides, as .gitkeep, does not count.
    filled = folder.exists() and any(not item.name.startswith('.') for item in folder.iterdir())
    if filled and not has_manifest(folder):
        raise DiffbotError(
            f'{folder}: holds something that is no data set, which is kept. '
            'Choose another folder for --out.'
        )


@contextmanager
def replacing(folder: Path) -> Iterator[Path]:
    """Yield an empty folder whose files take the place of an earlier data set at the end.

    After a failure the folder is as it was. Raises DiffbotError when it cannot be written, or
    holds what is no data set.
    """
    check_replaceable(folder)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with TemporaryDirectory(dir=folder, prefix='.unfinished-') as place:
            yield Path(place)
            _replace(folder, Path(place))
    except OSError as error:
        raise DiffbotError(f'{folder}: cannot be written: {error.strerror or error}.') from error


def _replace(folder: Path, place: Path) -> None:
    """Move the files in; the manifest, which makes the folder a data set, comes last."""
    for old in folder.iterdir():
        if TABLE.fullmatch(old.name):
            old.unlink()
    for new in sorted(place.iterdir(), key=lambda file: file.name == MANIFEST):
        new.replace(folder / new.name)
