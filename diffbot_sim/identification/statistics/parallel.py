"""Work on all cores."""

from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from os import cpu_count
from typing import TypeVar

Item = TypeVar('Item')
Result = TypeVar('Result')
_POOL = ThreadPoolExecutor(max_workers=cpu_count())


def each(work: Callable[[Item], Result], items: Iterable[Item]) -> list[Result]:
    """Return work done on every item, on all cores; work must not call this itself."""
    return list(_POOL.map(work, items))
