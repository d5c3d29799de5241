"""Reproduce the paper's experiments, check its claims, and demonstrate its errors."""

import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Sequence
from pathlib import Path

from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

from diffbot_sim.commands._recordings import check_out, folder
from diffbot_sim.errors import DiffbotError
from diffbot_sim.paper.catalogue import ERRATA, EXPERIMENTS, chosen
from diffbot_sim.paper.constants import Constants, load_constants
from diffbot_sim.paper.experiment import Claim
from diffbot_sim.paper.sensitivity import Range, first_failure, sensitivity
from diffbot_sim.paper.writing import FOLDER, Outcome, save, write_page


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the options."""
    parser.add_argument(
        'experiments', nargs='*', metavar='EXPERIMENT', help='by name; all if none is given'
    )
    parser.add_argument(
        '--out',
        type=folder,
        default=Path('out/paper'),
        metavar='DIR',
        help='folder for page, figures and series (default out/paper)',
    )
    parser.add_argument(
        '--constants', type=Path, metavar='FILE', help='parameter file in place of the chosen one'
    )
    parser.add_argument(
        '--sensitivity',
        action='store_true',
        help='also find how far each constant may move; about half a minute',
    )
    every = (*EXPERIMENTS, *ERRATA)
    parser.epilog = '\n'.join(['experiments:', *(f'  {e.name:14} {e.title}' for e in every)])


def run(arguments: Namespace) -> None:
    """Run the experiments one by one; the page comes last."""
    experiments = chosen(arguments.experiments)
    constants = load_constants(arguments.constants)
    check_out(arguments.out, [])
    outcomes = []
    for experiment in experiments:
        print(experiment.title, file=sys.stderr, flush=True)
        series = experiment.run(constants)
        save(experiment, series, arguments.out)
        outcomes.append(Outcome(experiment, experiment.claims(constants, series)))
    ranges = _ranges(constants) if arguments.sensitivity else []
    page = write_page(outcomes, ranges, arguments.constants, arguments.out)
    print_claims([claim for outcome in outcomes for claim in outcome.claims])
    print(f'page: {page}\nfigures and series: {arguments.out / FOLDER}')


def print_claims(claims: Sequence[Claim]) -> None:
    """Print the table of claims and how many hold."""
    console = Console(highlight=False)
    table = Table(box=box.SIMPLE_HEAD)
    for heading in ('where', 'what it says', 'measured', 'holds'):
        table.add_column(heading)
    for claim in claims:
        answer = Text('yes', 'green') if claim.holds else Text('no', 'bold red')
        table.add_row(claim.source, claim.statement, claim.measured, answer)
    console.print(table)
    console.print(f'{sum(claim.holds for claim in claims)} of {len(claims)} claims hold')


def _ranges(constants: Constants) -> list[Range]:
    fault = first_failure(constants)
    if fault:
        raise DiffbotError(
            f'--sensitivity: with these constants a claim fails already ({fault}). '
            'Leave the option out, or choose constants with which all hold.'
        )
    ranges = []
    for found in sensitivity(constants):
        print(f'{found.name}: {found.low:.3g} to {found.high:.3g}', file=sys.stderr, flush=True)
        ranges.append(found)
    return ranges
