"""Where an answer comes from: who finds a report later asks."""

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import date
from pathlib import Path

from diffbot_sim import __version__
from diffbot_sim.files import spelled


@dataclass(frozen=True)
class Origin:
    """Bags, as they were named, the parameter file, the day and the version.

    notes: what was noticed while the bags were read.
    """

    bags: tuple[str, ...]
    validate: tuple[str, ...]
    params: str
    day: str
    version: str
    notes: tuple[str, ...] = ()

    @property
    def words(self) -> str:
        """One line for people."""
        judged = f', judged by {", ".join(self.validate)}' if self.validate else ''
        return (
            f'diffbot_sim {self.version}, {self.day}: {", ".join(self.bags)}{judged}, '
            f'declared in {self.params}'
        )


def origin_of(
    bags: Sequence[Path], validate: Sequence[Path], params: Path, notes: Sequence[str]
) -> Origin:
    """Return the origin of what is told today."""
    learned, judged = (tuple(map(spelled, paths)) for paths in (bags, validate))
    today = date.today().isoformat()
    return Origin(learned, judged, spelled(params), today, __version__, tuple(notes))
