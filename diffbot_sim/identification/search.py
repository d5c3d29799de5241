"""The search: from recordings and a declared model to a structure that explains them."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial

from diffbot_sim.identification.doubt import doubt, with_friction_eased
from diffbot_sim.identification.fitting.calibration import calibrate, simulation_error
from diffbot_sim.identification.fitting.coordinates import Space
from diffbot_sim.identification.fitting.filtering import filter_behind, unfiltered
from diffbot_sim.identification.fitting.fit import FIRST_GAINS, Fit, fit_prediction, fit_simulation
from diffbot_sim.identification.fitting.predictor import MAX_STEP
from diffbot_sim.identification.fitting.shaking import shaken
from diffbot_sim.identification.free_forms.otherwise import moves_otherwise
from diffbot_sim.identification.later import sets_in_later
from diffbot_sim.identification.leading import acted_before, lead_of
from diffbot_sim.identification.older import Ages, Older, is_beyond_doubt, is_taken
from diffbot_sim.identification.recordings.checks import check
from diffbot_sim.identification.recordings.lateness import half_interval, timely, timing
from diffbot_sim.identification.recordings.recordings import Recordings
from diffbot_sim.identification.recordings.start import restarted
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.result import Structure, Timing
from diffbot_sim.identification.selection.stepwise import Selection, select
from diffbot_sim.identification.selection.trials import Progress
from diffbot_sim.identification.suspicion import SUSPICIOUS
from diffbot_sim.physics.effects import Effect
from diffbot_sim.physics.model import Model


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
    another form than declared, which is allowed for, lowers the deviance; time_constant [s]: of
    the filter of their twists that was undone, 0 if none was; undecided: whether twists may be
    older than their stamps; lead [s]: by how much forces were taken to act before theirs.
    """

    recordings: Recordings
    held_out: tuple[Stretch, ...]
    recalibrated: Fit
    undoubted: Selection
    selection: Selection
    unexplained: Structure | None
    near_rest: float = 0.0
    time_constant: float = 0.0
    undecided: bool = False
    lead: float = 0.0

    @property
    def says_something(self) -> bool:
        """Whether anything is named or left unexplained."""
        return bool(self.names) or self.unexplained is not None

    @property
    def names(self) -> frozenset[str]:
        """The effects that were found."""
        return frozenset(self.selection.support)

    def timed_like(self, other: 'Found') -> 'Found':
        """Return the same, its recordings taken to be timed as those of another search."""
        return replace(
            self,
            time_constant=other.time_constant,
            undecided=other.undecided,
            lead=other.lead,
        )

    def timings(self, given: Recordings) -> tuple[Timing, ...]:
        """Return how recordings were taken otherwise than they had been given."""
        leads = (Timing(run.name, self.lead, 'force') for run in given.all if self.lead > 0.0)
        return (*self._of_twists(given), *leads)

    def _of_twists(self, given: Recordings) -> Iterator[Timing]:
        if self.time_constant > 0.0:
            return (Timing(run.name, self.time_constant, 'filter') for run in given.all)
        if self.undecided:
            return (Timing(run.name, half_interval(run), 'undecided') for run in given.all)
        return filter(None, map(timing, given.all, self.recordings.all))


def search(
    recordings: Recordings, declared: Model, kinds: Sequence[type[Effect]], progress: Progress
) -> Found:
    """Search the structures made of these effects.

    Asks, too, whether twists or forces are stamped late, and what begins where runs are held out.
    Raises DataError where the runs are too short or do not move.
    """
    found = _settled(_timed(recordings, declared, kinds, progress), progress)
    found = _led(found, declared, kinds, progress)
    return _begun_later(found, declared, kinds, progress)


def _settled(found: Found, progress: Progress) -> Found:
    """Allow for friction near rest where something would be unexplained without that."""
    if found.unexplained is None:
        return found
    progress('allowing for friction near rest')
    doubted = doubt(found.undoubted, found.held_out, with_friction_eased)
    # What chance could allow for excuses nothing, nor does what leaves something else to be told.
    excused = doubted.unexplained is None and doubted.near_rest > SUSPICIOUS
    return replace(found, **doubted._asdict()) if excused else found


def _timed(
    recordings: Recordings, declared: Model, kinds: Sequence[type[Effect]], progress: Progress
) -> Found:
    """Search, and search again where twists may be older than their stamps, or filtered.

    Where they are older beyond doubt already for the declared model, that is searched first: most
    often nothing else needs to be.
    """
    begun = _begun(recordings.each(timely), declared, progress)
    known = dict[Older, Found]()

    def taken(older: Older) -> Found:
        if older not in known:
            progress(f'taking {older.what} for means since the sample before')
            known[older] = _search(begun.recordings.each(older.taken), declared, kinds, progress)
        return known[older]

    for older in Ages(begun.base, begun.recordings).beyond_doubt(kinds):
        final = taken(older).selection.final
        if is_beyond_doubt(older, final, begun.recordings, kinds):
            return taken(older)
    found = _found(begun, kinds, progress)
    # Doubt may have withdrawn a name for what late twists left beside it.
    first = found.undoubted.final
    ages = Ages(first, found.recordings)
    unexplained = 0.0 if found.unexplained is None else found.unexplained.worth
    for older in ages.likely if found.says_something else ():
        shown = partial(is_taken, older, first, unexplained=unexplained)
        if shown(taken(older).undoubted.final) or shown(ages.timely(older)):
            return taken(older)
    return replace(_unfiltered(found, declared, kinds, progress), undecided=ages.is_undecided)


def _unfiltered(
    found: Found, declared: Model, kinds: Sequence[type[Effect]], progress: Progress
) -> Found:
    """Search again where what is left of a filter may be held against the names found."""
    time_constant = filter_behind(found.undoubted.final)
    if time_constant <= 0.0:
        return found
    progress('undoing a filter of the twists')
    undone = found.recordings.each(partial(unfiltered, time_constant=time_constant))
    other = _search(undone, declared, kinds, progress)
    # What is undone must not bring about what was not there.
    if other.unexplained and not found.unexplained:
        return found
    return replace(other, time_constant=time_constant)


def _led(
    found: Found, declared: Model, kinds: Sequence[type[Effect]], progress: Progress
) -> Found:
    """Search again where forces act before their stamps, if that leaves less to be told."""
    lead = lead_of(found.undoubted.final) if found.says_something else 0.0
    if lead <= 0.0:
        return found
    progress('taking forces for older than their stamps')
    led = found.recordings.each(partial(acted_before, lead=lead))
    other = _settled(_search(led, declared, kinds, progress), progress)
    if other.unexplained or not (found.unexplained or other.names <= found.names):
        return found
    return replace(other.timed_like(found), lead=lead)


def _begun_later(
    found: Found, declared: Model, kinds: Sequence[type[Effect]], progress: Progress
) -> Found:
    """Search again with less held out, where something seems to begin in that alone."""
    if not _begins_later(found, kinds):
        return found
    progress('holding out less, since something begins there')
    less = found.recordings.less_held_out
    other = _settled(_search(less, declared, kinds, progress), progress)
    if other.unexplained or other.names <= found.names:
        return found
    return other.timed_like(found)


def _begins_later(found: Found, kinds: Sequence[type[Effect]]) -> bool:
    final = found.selection.final
    if found.recordings.validate or not found.recordings.allow_less_held_out:
        return False
    if found.unexplained is not None:
        return moves_otherwise(final, found.held_out) is not None
    return sets_in_later(final, found.recordings, kinds)


def _search(
    recordings: Recordings, declared: Model, kinds: Sequence[type[Effect]], progress: Progress
) -> Found:
    """Search in recordings that are taken as they are."""
    return _found(_begun(recordings, declared, progress), kinds, progress)


def _begun(recordings: Recordings, declared: Model, progress: Progress) -> Begun:
    """Recalibrate the declared model, and fit the noise model to it."""
    fitted, held_out = recordings.divided
    check(fitted, held_out)
    progress('calibrating the declared model')
    recalibrated = calibrate(Space(declared, ()), fitted)
    fitted = restarted(recalibrated.model, fitted, MAX_STEP)
    progress('fitting the noise model')
    near = fit_prediction(recalibrated.space, fitted, recalibrated.u, FIRST_GAINS)
    base = shaken(near)
    # One-step errors have fewer local minima: where they lead is one more start.
    again = fit_simulation(base.space, fitted, base.u)
    recalibrated = min(recalibrated, again, key=simulation_error)
    return Begun(recordings, held_out, recalibrated, base)


def _found(begun: Begun, kinds: Sequence[type[Effect]], progress: Progress) -> Found:
    """Find the structure, and doubt what was found."""
    selection = select(begun.base, kinds, begun.held_out, progress)
    progress('looking for structure that is left')
    doubted = doubt(selection, begun.held_out)
    return Found(begun.recordings, begun.held_out, begun.recalibrated, selection, *doubted)
