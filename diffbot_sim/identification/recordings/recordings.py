"""The recordings of one robot: what is learned from, and what is held out."""

from collections.abc import Callable
from dataclasses import dataclass

from diffbot_sim.identification.recordings.stretches import Stretch, split, whole
from diffbot_sim.records import Run


@dataclass(frozen=True)
class Recordings:
    """Runs to learn from; runs to validate with, or none: then parts of the first are held out."""

    learned: tuple[Run, ...]
    validate: tuple[Run, ...]

    @property
    def divided(self) -> tuple[tuple[Stretch, ...], tuple[Stretch, ...]]:
        """The stretches that are fitted, and those that are held out."""
        if self.validate:
            return whole(self.learned), whole(self.validate)
        return split(self.learned)

    @property
    def all(self) -> tuple[Run, ...]:
        """All runs."""
        return self.learned + self.validate

    def each(self, change: Callable[[Run], Run]) -> 'Recordings':
        """Return the recordings with each run changed."""
        return Recordings(tuple(map(change, self.learned)), tuple(map(change, self.validate)))
