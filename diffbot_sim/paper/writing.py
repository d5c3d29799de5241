"""What stays of an experiment: its series as CSV, its figures, and the page that tells of it."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jinja2 import Environment, PackageLoader, StrictUndefined

from diffbot_sim.paper.catalogue import ERRATA
from diffbot_sim.paper.constants import CONSTANTS_FILE
from diffbot_sim.paper.drawing import save_figures
from diffbot_sim.paper.experiment import Claim, Experiment, Series
from diffbot_sim.paper.sensitivity import Range

PAGE, FOLDER = 'paper.md', 'paper'


@dataclass(frozen=True)
class Outcome:
    """An experiment that was run, and what it shows."""

    experiment: Experiment
    claims: tuple[Claim, ...]

    @property
    def is_erratum(self) -> bool:
        """Whether it demonstrates an error of the paper."""
        return self.experiment in ERRATA


def save(experiment: Experiment, series: Series, out: Path) -> None:
    """Write an experiment's CSV and figures into the folder `paper` of out."""
    folder = out / FOLDER
    folder.mkdir(parents=True, exist_ok=True)
    rows = np.column_stack(list(series.values()))
    header = ','.join(series)
    target = folder / f'{experiment.name}.csv'
    np.savetxt(target, rows, '%.9g', ',', header=header, comments='', encoding='utf-8')
    save_figures(experiment, series, folder)


def write_page(
    outcomes: Sequence[Outcome], ranges: Sequence[Range], constants: Path | None, out: Path
) -> Path:
    """Write paper.md: claims, errata, constants and how far they may move; return its path."""
    (out / PAGE).write_text(page(outcomes, ranges, constants), 'utf-8')
    return out / PAGE


def page(outcomes: Sequence[Outcome], ranges: Sequence[Range], constants: Path | None) -> str:
    """Return the page in Markdown; ranges may be empty."""
    place = PackageLoader('diffbot_sim', 'paper')
    environment = Environment(
        loader=place,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    return environment.get_template(f'{PAGE}.j2').render(
        experiments=[outcome for outcome in outcomes if not outcome.is_erratum],
        errata=[outcome for outcome in outcomes if outcome.is_erratum],
        ranges=ranges,
        folder=FOLDER,
        constants=(constants or CONSTANTS_FILE).read_text('utf-8'),
    )
