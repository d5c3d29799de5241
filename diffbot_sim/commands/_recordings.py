"""What the commands that read bags share: their options and where they may write."""

import os
import sys
from argparse import ArgumentParser, ArgumentTypeError, Namespace
from collections.abc import Sequence
from pathlib import Path

from diffbot_sim.bags import RecordedRun, Topics, read_run
from diffbot_sim.errors import DiffbotError

MEANING = {
    'left-force': "the left wheel's force; usually left_wheel/force, else left_wheel/force_cmd",
    'right-force': "the right wheel's force, likewise",
    'odom': 'the odometry; usually odom',
}


def folder(name: str) -> Path:
    """Read the name of a folder; that of a variable that is not set is empty."""
    if not name:
        raise ArgumentTypeError('the name of the folder is empty')
    return Path(name)


def add_topic_options(parser: ArgumentParser) -> None:
    """Add --left-force, --right-force and --odom."""
    for name, meaning in MEANING.items():
        parser.add_argument(f'--{name}', metavar='TOPIC', help=meaning)


def read_bags(bags: Sequence[Path], options: Namespace) -> list[RecordedRun]:
    """Read the bags by the topics that the options name; tell what was noticed on stderr."""
    topics = Topics(options.left_force, options.right_force, options.odom)
    found = [read_run(bag, topics) for bag in bags]
    for recorded in found:
        for note in recorded.notes:
            print('note:', note, file=sys.stderr)
    return found


def check_out(out: Path, bags: Sequence[Path]) -> None:
    """Raise DiffbotError when results cannot be written to a folder, or would harm a bag."""
    for bag in bags:
        place = bag.parent if bag.is_file() else bag
        if out.resolve() == place.resolve():
            raise DiffbotError(f'{out}: holds the bag to read. Choose another folder for --out.')
    place = next(place for place in (out.resolve(), *out.resolve().parents) if place.exists())
    if not place.is_dir():
        raise DiffbotError(f'{out}: {place} is a file. Choose another folder for --out.')
    if not os.access(place, os.W_OK | os.X_OK):
        raise DiffbotError(f'{out}: {place} cannot be written. Choose another folder for --out.')
