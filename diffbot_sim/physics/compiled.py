"""How this room compiles: small functions into their callers, entries once, kept on disk."""

from collections.abc import Callable
from hashlib import sha256
from pathlib import Path
from typing import Any

from numba import njit

Function = Callable[..., Any]


def compiled(function: Function) -> Function:
    """Compile a function that only compiled code calls; nothing happens before its first use."""
    result: Function = njit(error_model='numpy', nogil=True)(function)
    return result


def entry(signature: Any) -> Callable[[Function], Function]:
    """Compile a function that Python calls, for one signature, and keep the result on disk.

    numba drops a kept result when the function's own file changes, but does not look at the
    functions that it calls; so the name under which it is kept tells the state of the whole room.
    """

    def decorate(function: Function) -> Function:
        function.__qualname__ += '_' + _SOURCES
        result: Function = njit(signature, cache=True, nogil=True, error_model='numpy')(function)
        return result

    return decorate


def _digest_of_room() -> str:
    digest = sha256()
    for path in sorted(Path(__file__).parent.glob('*.py')):
        digest.update(path.read_bytes())
    return digest.hexdigest()[:12]


_SOURCES = _digest_of_room()
