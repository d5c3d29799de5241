"""How this room compiles: small functions into their callers, entries once, kept on disk.

Compiled code allocates nothing: without numba's runtime (NRT), which would count the owners of
arrays in atomic steps at every call, it takes less than half the time.
"""

from collections.abc import Callable, Iterable
from hashlib import sha256
from pathlib import Path
from typing import Any

from numba import njit, types

Function = Callable[..., Any]
_OPTIONS = {'error_model': 'numpy', 'nogil': True, '_nrt': False}


def compiled(function: Function) -> Function:
    """Compile a function that only compiled code calls; nothing happens before its first use."""
    result: Function = njit(**_OPTIONS)(function)
    return result


def entry(signature: Any, key: str = '') -> Callable[[Function], Function]:
    """Compile a function that Python calls, for one signature, and keep the result on disk.

    numba drops a kept result when the function's own file changes, but does not look at the
    functions that it calls; so the name under which it is kept tells the state of the whole room,
    and by a key that of whatever else it calls.
    """

    def decorate(function: Function) -> Function:
        function.__qualname__ += f'_{_SOURCES}{key}'
        result: Function = njit(signature, cache=True, **_OPTIONS)(function)
        return result

    return decorate


class Pointer:
    """A compiled function to hand to an entry: numba looks up a plain one at every call."""

    def __init__(self, function: Any, signature: Any) -> None:
        self._function = function  # kept, so that the code is
        self._numba_type_ = types.FunctionType(signature)
        found = function.get_compile_result(signature)
        self._address = found.library.get_pointer_to_function(found.fndesc.llvm_cfunc_wrapper_name)

    def __call__(self, *values: Any) -> Any:
        """Call it as Python does."""
        return self._function(*values)

    def __wrapper_address__(self) -> Any:
        return self._address


def digest_of(names: Iterable[str], files: Iterable[Path]) -> str:
    """Return a short text that changes with any of the names or with what any file holds."""
    digest = sha256('\n'.join(names).encode())
    for path in sorted(files):
        digest.update(path.read_bytes())
    return digest.hexdigest()[:12]


_SOURCES = digest_of([], Path(__file__).parent.rglob('*.py'))
