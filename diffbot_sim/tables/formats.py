"""The formats of a table, one file each: a module of the format's name that offers write()."""

from collections.abc import Callable, Mapping
from importlib import import_module
from pathlib import Path

from diffbot_sim.errors import DiffbotError
from diffbot_sim.records import Array

FORMATS = ('npz', 'parquet')

# (path, columns by name) -> None
Writer = Callable[[Path, Mapping[str, Array]], None]


def writer(name: str) -> Writer:
    """Return what writes tables of a format; raises DiffbotError if its package does not load."""
    try:
        module = import_module(f'{__package__}.{name}')
    except ModuleNotFoundError as error:
        missing = (error.name or '').partition('.')[0]
        raise DiffbotError(
            f"--format {name} needs '{missing}', which is not installed. "
            f"Install it with 'pip install {missing}', or use --format npz."
        ) from error
    except ImportError as error:
        raise DiffbotError(f'--format {name}: {error}. Mend that, or use --format npz.') from error
    write: Writer = module.write
    return write
