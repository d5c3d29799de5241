"""What an experiment is: a run, its figures, and what it shows."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TypeAlias

from matplotlib.figure import Figure

from diffbot_sim.paper.constants import Constants
from diffbot_sim.records import Array

# Columns of equal length by name and unit, such as 'v [m/s]', in the order in which they are kept.
Series: TypeAlias = Mapping[str, Array]


@dataclass(frozen=True)
class Claim:
    """One sentence of the paper, in our words, and what the computation says of it.

    source: where the paper says it; measured: the numbers that decide.
    """

    source: str
    statement: str
    measured: str
    holds: bool


@dataclass(frozen=True)
class Experiment:
    """One experiment, or one error of the paper with its demonstration.

    note: what is prescribed and what to look at, in Markdown. run computes the series; each of
    the figures draws them; claims holds them against the text.
    """

    name: str
    title: str
    note: str
    run: Callable[[Constants], Series]
    figures: Mapping[str, Callable[[Series, Figure], None]]
    claims: Callable[[Constants, Series], tuple[Claim, ...]]
