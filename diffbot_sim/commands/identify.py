"""Learn from bags what the declared model lacks; save report, model and residual."""

import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from diffbot_sim import __version__
from diffbot_sim.bags import RecordedRun, check_replaceable, write_series
from diffbot_sim.commands._recordings import add_topic_options, check_out, read_bags
from diffbot_sim.commands._residual import residual_series
from diffbot_sim.config import load_model, save_model
from diffbot_sim.identification import identify
from diffbot_sim.identification.result import Identification
from diffbot_sim.report import print_summary, write_report

RESIDUAL = 'residual'


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the options."""
    parser.add_argument(
        'bags', type=Path, nargs='+', metavar='BAG', help='rosbag2 folders, .mcap or .db3 files'
    )
    parser.add_argument(
        '--params', required=True, metavar='FILE', help='parameter file (YAML) with what is known'
    )
    parser.add_argument(
        '--out', type=Path, required=True, metavar='DIR', help='folder for the results'
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
    check_out(arguments.out, [*arguments.bags, *arguments.validate])
    check_replaceable(arguments.out / RESIDUAL)
    declared = load_model(arguments.params)
    recorded = distinct(read_bags([*arguments.bags, *arguments.validate], arguments))
    runs = [item.run for item in recorded]
    count = len(arguments.bags)
    result = identify(runs[:count], declared, runs[count:], progress=_tell)
    save(result, arguments.out, recorded[:count], recorded[count:])
    print_summary(result)
    print(f'report: {arguments.out / "report.html"}')


def distinct(recorded: Sequence[RecordedRun]) -> list[RecordedRun]:
    """Number runs of equal name, since results refer to runs by name."""
    names = [item.run.name for item in recorded]
    return [
        replace(item, run=replace(item.run, name=f'{name}_{i + 1}'))
        if names.count(name) > 1
        else item
        for i, (name, item) in enumerate(zip(names, recorded, strict=True))
    ]


def save(
    result: Identification,
    out: Path,
    recorded: Sequence[RecordedRun],
    validate: Sequence[RecordedRun],
) -> None:
    """Write report.json, report.html, model.yaml and the residual bag."""
    write_report(result, out)
    save_model(result.identified, out / 'model.yaml', _origin(result, recorded))
    starts = {item.run.name: item.start_ns for item in (*recorded, *validate)}
    first = min(starts.values())
    series = residual_series(result.comparisons, {n: s - first for n, s in starts.items()})
    write_series(out / RESIDUAL, series, first)


def _origin(result: Identification, recorded: Sequence[RecordedRun]) -> str:
    """Say where a model comes from, for the head of its file."""
    found = ', '.join(effect.name for effect in result.effects) or 'none'
    bags = ', '.join(item.run.name for item in recorded)
    return f'Identified by diffbot_sim {__version__} from {bags}.\nEffects added: {found}.'


def _tell(text: str) -> None:
    print(text, file=sys.stderr, flush=True)
