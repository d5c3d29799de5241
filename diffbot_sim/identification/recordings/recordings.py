"""The recordings of one robot: what is learned from, and what is held out."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from diffbot_sim.errors import DataError
from diffbot_sim.identification.recordings.stretches import (
    FITTED_SHARE,
    LARGER_SHARE,
    Stretch,
    split,
    whole,
)
from diffbot_sim.records import Run


@dataclass(frozen=True)
class Recordings:
    """Runs to learn from; runs to validate with, or none: then parts of the first are held out.

    share: what is fitted of each run then; aside: which of those to learn from are set aside,
    since they disagree with the others: nothing is learned from these, nor judged by them.
    """

    learned: tuple[Run, ...]
    validate: tuple[Run, ...]
    share: float = FITTED_SHARE
    aside: frozenset[int] = frozenset()

    @property
    def kept(self) -> tuple[Run, ...]:
        """The runs that are learned from."""
        return tuple(run for i, run in enumerate(self.learned) if i not in self.aside)

    @property
    def divided(self) -> tuple[tuple[Stretch, ...], tuple[Stretch, ...]]:
        """The stretches that are fitted, and those that are held out."""
        if self.validate:
            return whole(self.kept), whole(self.validate)
        return split(self.kept, self.share)

    @property
    def allow_less_held_out(self) -> bool:
        """Whether less of each run would be enough to judge by."""
        try:
            split(self.kept, LARGER_SHARE)
        except DataError:
            return False
        return True

    @property
    def less_held_out(self) -> 'Recordings':
        """The same, with less of each run held out, where no run is to validate with."""
        return replace(self, share=LARGER_SHARE)

    @property
    def all(self) -> tuple[Run, ...]:
        """All runs, those set aside among them."""
        return self.learned + self.validate

    def rolled(self, before: Sequence[tuple[float, float]]) -> 'Recordings':
        """Return the recordings whose wheels had rolled so far before each run, as in Run."""
        runs = [replace(run, rolled=it) for run, it in zip(self.all, before, strict=True)]
        learned = len(self.learned)
        return replace(self, learned=tuple(runs[:learned]), validate=tuple(runs[learned:]))

    def each(self, change: Callable[[Run], Run]) -> 'Recordings':
        """Return the recordings with each run changed."""
        learned, validate = (tuple(map(change, runs)) for runs in (self.learned, self.validate))
        return replace(self, learned=learned, validate=validate)
