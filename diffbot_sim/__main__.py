"""Simulate a differential-drive robot with friction, and learn from its bags what is missing."""

import ast
import os
import signal
import sys
from argparse import ArgumentParser, RawDescriptionHelpFormatter
from collections.abc import Iterable, Iterator, Sequence
from importlib import import_module
from importlib.resources import files
from io import TextIOWrapper
from threading import Timer
from typing import Any, NoReturn

from diffbot_sim import __version__
from diffbot_sim.errors import DiffbotError
from diffbot_sim.parameters import suggestion

NODES = ('simulator', 'pi_controller', 'driver', 'recorder', 'replay')
INTERRUPTED = 130
SILENT = 8.0  # [s]
COMPILES = 'loading; the first start compiles the laws of motion, which takes some 20 s'
# Our own threads share the work; those of linear algebra would only wait for each other.
THREADS = ('OPENBLAS_NUM_THREADS', 'OMP_NUM_THREADS', 'MKL_NUM_THREADS')


def main(argv: Sequence[str] | None = None, command: str | None = None) -> int:
    """Run a command and return the exit code: 0 done, 1 a known problem, told in one line.

    argv: the words after the command; with command=None its name comes first. Wrong usage
    leaves with SystemExit(2).
    """
    words = [*([command] if command else []), *(sys.argv[1:] if argv is None else argv)]
    _replace_unprintable()
    try:
        code = _run(words)
        if sys.stdout:  # which may be closed
            sys.stdout.flush()
    except BrokenPipeError:
        return _drop_broken_pipe()
    except (DiffbotError, OSError) as problem:
        print('error:', ' '.join(str(problem).split()), file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return INTERRUPTED
    return code


def _run(words: list[str]) -> int:
    if not words or words[0].startswith('-'):
        _refuse(words, 'give a COMMAND')
    name, *rest = words
    if name in NODES:
        # The first start compiles, which swallows a KeyboardInterrupt: until the node listens to
        # signals itself, Ctrl-C simply ends it.
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        return int(_loaded(f'nodes.{name}').main(rest))
    if name not in _commands():
        _refuse([], f"unknown command '{name}'. {suggestion(name, [*NODES, *_commands()])}")
    module = _loaded(f'commands.{name}')
    parser = _parser(f'diffbot_sim {name}', module.__doc__)
    module.add_arguments(parser)
    module.run(parser.parse_args(rest))
    return 0


def _refuse(words: list[str], fault: str) -> NoReturn:
    """Answer what is not a command: --help, --version or a fault."""
    parser = _parser('diffbot_sim', f'{__doc__}\n\n{_listing()}')
    parser.usage = 'diffbot_sim COMMAND ...'
    parser.add_argument('--version', action='version', version=f'diffbot_sim {__version__}')
    parser.parse_args(words)
    parser.error(fault)


def _parser(name: str, description: str | None) -> ArgumentParser:
    return ArgumentParser(
        prog=name, description=description, formatter_class=RawDescriptionHelpFormatter
    )


def _listing() -> str:
    rows = [('offline tools:', ''), *_summaries('commands', _commands()), ('', '')]
    rows += [('ROS 2 nodes:', ''), *_summaries('nodes', NODES)]
    lines = (f'  {name:14} {text}' if text else name for name, text in rows)
    return '\n'.join((*lines, '', "'diffbot_sim COMMAND --help' tells more."))


def _commands() -> list[str]:
    found = (file.name for file in (files('diffbot_sim') / 'commands').iterdir())
    names = (name.removesuffix('.py') for name in found if name.endswith('.py'))
    return sorted(name for name in names if not name.startswith('_'))


def _summaries(room: str, names: Iterable[str]) -> Iterator[tuple[str, str]]:
    """Read the first lines of docstrings, without importing what may need ROS."""
    for name in names:
        source = files('diffbot_sim') / room / f'{name}.py'
        if source.is_file():
            text = ast.get_docstring(ast.parse(source.read_text('utf-8'))) or ''
            yield name, text.partition('\n')[0]


def _loaded(module: str) -> Any:
    for name in THREADS:  # read when numpy is loaded, which is now
        os.environ.setdefault(name, '1')
    explains = Timer(SILENT, print, [COMPILES], {'file': sys.stderr, 'flush': True})
    explains.start()
    try:
        return import_module(f'diffbot_sim.{module}')
    except ModuleNotFoundError as error:
        missing = (error.name or '').partition('.')[0]
        if missing == 'diffbot_sim':
            raise
        raise DiffbotError(
            f"{module.rpartition('.')[2]} needs '{missing}', which is not installed. Source a "
            "ROS 2 workspace (Jazzy or Kilted), or use the Python of 'make' in .venv/bin."
        ) from error
    finally:
        explains.cancel()


def _replace_unprintable() -> None:
    """Let terminals that lack a letter, such as ω, show a question mark in its place."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors='replace')


def _drop_broken_pipe() -> int:
    """Let go of a pipe that nobody reads, so that Python does not complain at exit."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return 1


if __name__ == '__main__':
    sys.exit(main())
