"""Learn from bags what the declared model lacks; save report, model and residual."""

import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Sequence
from dataclasses import replace
from itertools import chain, count
from pathlib import Path

from diffbot_sim.bags import RecordedRun, check_replaceable, write_series
from diffbot_sim.commands._recordings import add_topic_options, check_out, folder, read_bags
from diffbot_sim.commands._residual import residual_series
from diffbot_sim.config import left_out, load_model, save_model
from diffbot_sim.errors import DiffbotError
from diffbot_sim.files import spelled
from diffbot_sim.identification import identify
from diffbot_sim.identification.recordings.parts import between
from diffbot_sim.identification.result import Identification
from diffbot_sim.parameters import specs
from diffbot_sim.physics.model import Model
from diffbot_sim.report import Origin, origin_of, print_summary, write_report

RESIDUAL, MODEL = 'residual', 'model.yaml'
# How a model begins that was identified: no other one is replaced.
IDENTIFIED = 'Identified'
# Lengths that nothing in a drive tells, so that they are not fitted.
LENGTHS = ('wheel_separation', 'wheel_radius')
# Guesses at what is fitted.
GUESSED = ('mass', 'inertia')


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the options."""
    parser.add_argument(
        'bags', type=Path, nargs='+', metavar='BAG', help='rosbag2 folders, .mcap or .db3 files'
    )
    parser.add_argument(
        '--params',
        type=Path,
        required=True,
        metavar='FILE',
        help='parameter file (YAML) with what is known',
    )
    parser.add_argument(
        '--out', type=folder, required=True, metavar='DIR', help='folder for the results'
    )
    parser.add_argument(
        '--validate',
        type=Path,
        nargs='+',
        default=[],
        metavar='BAG',
        help='bags to judge by; without them, the last part of each BAG is held out',
    )
    add_topic_options(parser)


def run(arguments: Namespace) -> None:
    """Identify; nothing is written before that has succeeded."""
    bags = [*arguments.bags, *arguments.validate]
    check_out(arguments.out, bags)
    check_replaceable(arguments.out / RESIDUAL)
    _check_apart(bags)
    declared = _declared(arguments.params, arguments.out)
    read = read_bags(bags, arguments)
    _check_copies(bags, read)
    named = zip(bags, read, distinct(read), strict=True)
    parted = [in_parts(_called_otherwise(*item)) for item in named]
    learned = len(arguments.bags)
    given, others = (list(chain(*items)) for items in (parted[:learned], parted[learned:]))
    runs, validate = ([item.run for item in items] for items in (given, others))
    result = identify(runs, declared, validate, progress=_tell)
    notes = [note for first, *_ in parted for note in first.notes]
    origin = origin_of(arguments.bags, arguments.validate, arguments.params, notes)
    save(result, origin, arguments.out, [*given, *others])
    print_summary(result)
    print(f'report: {arguments.out / "report.html"}')


def _check_apart(bags: Sequence[Path]) -> None:
    """Refuse a bag that is given twice: it would be counted, or judged, as if it were another."""
    places = [bag.resolve() for bag in bags]
    for index, bag in enumerate(bags):
        if places[index] in places[:index]:
            raise DiffbotError(f'{bag}: given twice. Give each bag once, to learn or --validate.')


def _check_copies(bags: Sequence[Path], read: Sequence[RecordedRun]) -> None:
    """Refuse a copy of a bag, likewise."""
    moved = [(item.start_ns, item.run.odometry.twist.tobytes()) for item in read]
    for index, bag in enumerate(bags):
        first = moved.index(moved[index])
        if first < index:
            raise DiffbotError(
                f'{bag}: holds the drive of {bags[first]}. Give each drive once, to learn or '
                '--validate.'
            )


def _declared(params: Path, out: Path) -> Model:
    """Read the declared model, and tell which numbers it has from nobody."""
    model = out / MODEL
    if params.resolve() == model.resolve():
        raise DiffbotError(
            f'{params}: the result would take its place. Choose another folder for --out.'
        )
    if model.exists() and not model.read_text('utf-8', 'replace').startswith(f'# {IDENTIFIED}'):
        raise DiffbotError(
            f'{model}: is of another hand, and is kept. Choose another folder for --out.'
        )
    declared = load_model(params)
    units = {spec.name: spec.unit for spec in specs(declared.robot)}
    for name in left_out(params, 'robot', (*LENGTHS, *GUESSED)):
        then = 'taken, and not fitted' if name in LENGTHS else 'where its fit begins'
        value = f'{getattr(declared.robot, name):g} {units[name]}'
        _tell(f'note: {params}: robot.{name} is not given; {value} is {then}')
    return declared


def distinct(recorded: Sequence[RecordedRun]) -> list[RecordedRun]:
    """Number runs of equal name, since results refer to runs by name."""
    names = [item.run.name for item in recorded]
    taken = {name for name in names if names.count(name) == 1}
    found = []
    for item in recorded:
        name = item.run.name
        if names.count(name) > 1:
            numbered = (f'{name}_{number}' for number in count(1))
            name = next(free for free in numbered if free not in taken)
            taken.add(name)
        found.append(_called(name, item))
    return found


def _called(name: str, item: RecordedRun) -> RecordedRun:
    """Return a run by another name, in its notes, too."""
    before = f'{item.run.name}: '
    notes = tuple(f'{name}: {note.removeprefix(before)}' for note in item.notes)
    return replace(item, run=replace(item.run, name=name), notes=notes)


def _called_otherwise(bag: Path, was: RecordedRun, now: RecordedRun) -> RecordedRun:
    """Return a run with a note on which bag it is, if its name was changed."""
    name = now.run.name
    return now if name == was.run.name else _noted(now, f'{name} is {spelled(bag)}')


def in_parts(item: RecordedRun) -> list[RecordedRun]:
    """Return a run that was not recorded all along as one for each part, with a note on them."""
    parts = between(item.run, item.pauses)
    if parts[0] is item.run:
        return [item]
    names = ', '.join(part.name for part in parts)
    told = _noted(item, f'{item.run.name}: what lies between its holes is taken as: {names}')
    return [replace(told, run=part) for part in parts]


def _noted(item: RecordedRun, note: str) -> RecordedRun:
    """Return a run with one note more, which is told."""
    _tell(f'note: {note}')
    return replace(item, notes=(*item.notes, note))


def save(
    result: Identification, origin: Origin, out: Path, recorded: Sequence[RecordedRun]
) -> None:
    """Write report.json, report.html, model.yaml and the residual bag."""
    write_report(result, origin, out)
    save_model(result.identified, out / MODEL, _head(result, origin))
    starts = {item.run.name: item.start_ns for item in recorded}
    first = min(starts.values())
    series = residual_series(result.comparisons, {n: s - first for n, s in starts.items()})
    write_series(out / RESIDUAL, series, first)


def _head(result: Identification, origin: Origin) -> str:
    """Say where a model comes from, for the head of its file."""
    found = ', '.join(effect.name for effect in result.effects) or 'none'
    return f'{IDENTIFIED}: {origin.words}.\nEffects added: {found}.'


def _tell(text: str) -> None:
    print(text, file=sys.stderr, flush=True)
