"""Work on all cores: small pieces of a fit, and whole fits side by side."""

from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from os import cpu_count
from typing import TypeVar

Item = TypeVar('Item')
Result = TypeVar('Result')
# Of its own for each, so that fits wait for their pieces and never for each other.
_PIECES, _FITS = ThreadPoolExecutor(cpu_count()), ThreadPoolExecutor(cpu_count())


def each(work: Callable[[Item], Result], items: Iterable[Item]) -> list[Result]:
    """Return work done on every item, on all cores; work must not call this itself."""
    return list(_PIECES.map(work, items))


def side_by_side(work: Callable[[Item], Result], items: Iterable[Item]) -> list[Result]:
    """Return work done on every item, on all cores; work may call `each`, but not this itself."""
    return list(_FITS.map(work, items))
