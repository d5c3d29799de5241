"""Keys that are pressed at the terminal, one by one, without Enter."""

import os
import sys
import termios
import tty
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from select import select

LONGEST = 8  # bytes of one key


@contextmanager
def pressed_keys() -> Iterator[Callable[[], str]]:
    """Offer what reads the key that was pressed last, '' if none; the terminal is put back.

    Without a terminal, or in the background of one, nothing is ever pressed.
    """
    if not _is_ours():
        yield lambda: ''
        return
    terminal = sys.stdin.fileno()
    before = termios.tcgetattr(terminal)
    try:
        tty.setcbreak(terminal)
        yield partial(_read, terminal)
    finally:
        if _is_ours():
            termios.tcsetattr(terminal, termios.TCSADRAIN, before)


def _is_ours() -> bool:
    """Say whether the terminal listens to us; it stops a process that touches it unasked."""
    if sys.stdin is None or not sys.stdin.isatty():
        return False
    try:
        return os.tcgetpgrp(sys.stdin.fileno()) == os.getpgrp()
    except OSError:  # a terminal without background
        return True


def _read(terminal: int) -> str:
    if not select([terminal], [], [], 0.0)[0] or not _is_ours():
        return ''
    return os.read(terminal, LONGEST).decode(errors='replace')
