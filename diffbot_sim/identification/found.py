"""What a search finds in recordings, and what it begins with."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import partial

from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.recordings.filters import Filter
from diffbot_sim.identification.recordings.intervals import median_interval
from diffbot_sim.identification.recordings.lateness import half_interval, timely, timing
from diffbot_sim.identification.recordings.recordings import Recordings
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.result import Structure, Timing
from diffbot_sim.identification.selection.stepwise import Selection
from diffbot_sim.records import Run


@dataclass(frozen=True)
class Begun:
    """A declared model recalibrated on recordings, and fitted with the noise model."""

    recordings: Recordings
    held_out: tuple[Stretch, ...]
    recalibrated: Fit
    base: Fit


@dataclass(frozen=True)
class Found:
    """What was found in recordings, as they were taken to be timed.

    undoubted: as it was before names were doubted; near_rest: by how much a friction near rest of
    another form than declared, which is allowed for, lowers the deviance; behind: the
    filter of their twists that was undone, if one was; undecided: whether twists may be
    older than their stamps; lead [s]: by how much forces were taken to act before theirs;
    noisy: the recordings, timely, with noise added, if they had none; None if they had;
    aside: the runs that were set aside, and which effects each has that the others deny.
    """

    recordings: Recordings
    held_out: tuple[Stretch, ...]
    recalibrated: Fit
    undoubted: Selection
    selection: Selection
    unexplained: Structure | None
    near_rest: float = 0.0
    behind: Filter | None = None
    undecided: bool = False
    lead: float = 0.0
    noisy: Recordings | None = None
    aside: Mapping[int, frozenset[str]] = field(default_factory=dict)

    @property
    def says_something(self) -> bool:
        """Whether anything is named or left unexplained."""
        return bool(self.names) or self.unexplained is not None

    @property
    def tells_all(self) -> bool:
        """Whether names account for all that is told, and none was doubted."""
        return bool(self.names) and not self.unexplained and self.selection is self.undoubted

    @property
    def names(self) -> frozenset[str]:
        """The effects that were found."""
        return frozenset(self.selection.support)

    def timed_like(self, other: 'Found') -> 'Found':
        """Return the same, its recordings taken to be timed as those of another search."""
        return replace(
            self,
            behind=other.behind,
            undecided=other.undecided,
            lead=other.lead,
        )

    def timings(self, given: Recordings) -> tuple[Timing, ...]:
        """Return how recordings were taken otherwise than they had been given, but for noise."""
        leads = (Timing(run.name, self.lead, 'force') for run in given.all if self.lead > 0.0)
        return (*self._of_twists(given), *leads)

    def _of_twists(self, given: Recordings) -> Iterator[Timing]:
        if self.behind is not None:
            return map(partial(_behind, self.behind), given.all)
        if self.undecided:
            return (Timing(run.name, half_interval(run), 'undecided') for run in given.all)
        if self.noisy is None:
            return filter(None, map(timing, given.all, self.recordings.all))
        before = map(timing, given.all, given.each(timely).all)
        return filter(None, [*before, *map(timing, self.noisy.all, self.recordings.all)])


def _behind(behind: Filter, run: Run) -> Timing:
    """Return how late a filter makes the twists of a run; one that looks ahead, not at all."""
    return Timing(
        run.name, max(0.0, behind.lateness(median_interval(run.odometry.time))), 'filter'
    )
