"""The search: from recordings and a declared model to a structure that explains them."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

from diffbot_sim.errors import DataError
from diffbot_sim.identification.allowing import allowing_friction
from diffbot_sim.identification.doubt import Seen, doubt
from diffbot_sim.identification.fitting.calibration import calibrate, simulation_error
from diffbot_sim.identification.fitting.coordinates import Space
from diffbot_sim.identification.fitting.filtering import filter_behind, unfiltered
from diffbot_sim.identification.fitting.fit import FIRST_GAINS, fit_prediction, fit_simulation
from diffbot_sim.identification.fitting.shaking import shaken
from diffbot_sim.identification.fitting.units import within_reach
from diffbot_sim.identification.found import Begun, Found
from diffbot_sim.identification.free_forms.otherwise import moves_otherwise
from diffbot_sim.identification.later import sets_in_later
from diffbot_sim.identification.leading import lead_of
from diffbot_sim.identification.odd_ones import denied_by, odd_among
from diffbot_sim.identification.older import (
    Ages,
    Older,
    is_beyond_doubt,
    is_taken,
    lead_of_means,
)
from diffbot_sim.identification.recordings.acting import acted_before
from diffbot_sim.identification.recordings.checks import check
from diffbot_sim.identification.recordings.lateness import timely
from diffbot_sim.identification.recordings.noiseless import (
    odometry_noise,
    with_noise,
)
from diffbot_sim.identification.recordings.recordings import Recordings
from diffbot_sim.identification.recordings.start import restarted
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.selection.stepwise import select
from diffbot_sim.identification.selection.trials import Progress
from diffbot_sim.identification.simulating import is_integrators, without_worsening
from diffbot_sim.identification.standing_wheels import standing
from diffbot_sim.physics.effects import Effect
from diffbot_sim.physics.effects.wheel_ripple import WheelRipple
from diffbot_sim.physics.model import Model
from diffbot_sim.records import Run


@dataclass(frozen=True)
class Question:
    """What is asked of recordings: which of the effects known the declared model lacks."""

    declared: Model
    known: Sequence[type[Effect]]
    progress: Progress

    @property
    def kinds(self) -> tuple[type[Effect], ...]:
        """The effects to try: what the declared model has is not missing."""
        present = {effect.name for effect in self.declared.effects}
        return tuple(kind for kind in self.known if kind.name not in present)


def search(recordings: Recordings, question: Question) -> Found:
    """Search the structures made of these effects.

    Asks, too, whether twists or forces are stamped late, and what begins where runs are held out.
    What is left of recordings without noise may be the integrator of a simulator, and hide what
    is missing: then they are searched again as a good odometry would have told them.
    Raises DataError where the runs are too short or do not move, or a number of the declared
    robot is in another unit.
    """
    fitted, _ = _divided(recordings)
    # What is declared stays the same, however the runs are taken or divided.
    question = replace(question, declared=within_reach(question.declared, fitted))
    found = _answered(recordings, question)
    noise = odometry_noise(question.declared.half_separation)
    if not is_integrators(found, noise):
        return found
    question.progress('adding the noise of a good odometry')
    noisy = recordings.each(partial(with_noise, noise=noise))
    return replace(_answered(noisy, question), noisy=noisy)


def recalibrated(recordings: Recordings, question: Question) -> Found:
    """Recalibrate the declared model, and look for nothing that it lacks."""
    begun = _begun(recordings, question)
    alone = select(begun.base, (), begun.held_out, question.progress)
    return Found(begun.recordings, begun.held_out, begun.recalibrated, alone, alone, None)


def _answered(recordings: Recordings, question: Question) -> Found:
    """Search in all runs, and without those that disagree where that leaves less to be told.

    Each run that is set aside must have nothing unexplained, either, and no effect but what the
    others have or deny: what shows in some runs alone is no reason to leave these out.
    """
    found = _asked(recordings, question)
    odd = odd_among(found)
    if not odd:
        return found
    question.progress('setting aside what disagrees with the other runs')
    others = _asked(replace(recordings, aside=odd), question)
    if others.unexplained or not (found.unexplained or others.names < found.names):
        return found
    own = {index: _own_effects(recordings.learned[index], others, question) for index in odd}
    known = {index: names for index, names in own.items() if names is not None}
    return replace(others, aside=known) if len(known) == len(odd) else found


def _own_effects(run: Run, others: Found, question: Question) -> frozenset[str] | None:
    """Return the effects of a run by itself that the others deny; nothing if it stays unclear."""
    try:
        alone = _asked(Recordings((run,), ()), question)
    except DataError:  # too short
        return None
    return None if alone.unexplained else denied_by(others, alone)


def _asked(recordings: Recordings, question: Question) -> Found:
    """Search in recordings, and ask all that may be wrong with their stamps and their friction."""
    found = _settled(_timed(recordings, question), question)
    return without_worsening(_begun_later(_allowing_a_lead(found, question), question))


def _settled(found: Found, question: Question) -> Found:
    """Allow for friction near rest where something would be unexplained without that."""
    if found.unexplained is None:
        return found
    question.progress('allowing for friction near rest')
    return allowing_friction(found)


def _timed(recordings: Recordings, question: Question) -> Found:
    """Search, and search again where twists may be older than their stamps, or filtered.

    Where they are older beyond doubt already for the declared model, that is searched first: most
    often nothing else needs to be.
    """
    begun = _begun(recordings.each(timely), question)
    known = dict[Older, Found]()

    def taken(older: Older) -> Found:
        if older not in known:
            question.progress(f'taking {older.what} for means since the sample before')
            known[older] = _search(begun.recordings.each(older.taken), question)
        return known[older]

    for older in Ages(begun.base, begun.recordings).beyond_doubt(question.kinds):
        final = taken(older).selection.final
        if is_beyond_doubt(older, final, begun.recordings, question.kinds):
            return taken(older)
    found = _found(begun, question)
    # Doubt may have withdrawn a name for what late twists left beside it.
    first = found.undoubted.final
    ages = Ages(first, found.recordings)
    unexplained = 0.0 if found.unexplained is None else found.unexplained.worth
    for older in ages.likely if found.says_something else ():
        ends = (taken(older).undoubted.final, ages.timely(older))
        if any(is_taken(older, first, end, unexplained) for end in ends):
            return taken(older)
        lead = max(lead_of_means(older, first, end, unexplained) for end in ends)
        if lead > 0.0:
            return _taken_as_led(taken(older).recordings, lead, question)
    return replace(_unfiltered(found, question), undecided=ages.is_undecided)


def _unfiltered(found: Found, question: Question) -> Found:
    """Search again where what is left of a filter may be held against the names found."""
    behind = filter_behind(found.undoubted.final)
    if behind is None:
        return found
    question.progress('undoing a filter of the twists')
    undone = found.recordings.each(partial(unfiltered, behind=behind))
    other = _search(undone, question)
    # What is undone must not bring about what was not there, and speaks as loudly.
    if other.unexplained and not found.unexplained and other.unexplained.worth > behind.worth:
        return found
    return replace(other, time_constant=behind.time_constant)


def _allowing_a_lead(found: Found, question: Question) -> Found:
    """Search again where forces act before their stamps, if that leaves less to be told."""
    if found.lead > 0.0 or not found.says_something:
        return found
    lead = lead_of(found.undoubted.final)
    if lead <= 0.0:
        return found
    other = _settled(_taken_as_led(found.recordings, lead, question), question)
    if other.unexplained or not (found.unexplained or other.names <= found.names):
        return found
    return replace(other.timed_like(found), lead=lead)


def _taken_as_led(recordings: Recordings, lead: float, question: Question) -> Found:
    """Search in recordings whose forces are taken to act so long before their stamps [s]."""
    question.progress('taking forces for older than their stamps')
    led = recordings.each(partial(acted_before, lead=lead))
    return replace(_search(led, question), lead=lead)


def _begun_later(found: Found, question: Question) -> Found:
    """Search again with less held out, where something seems to begin in that alone."""
    if not _begins_later(found, question.kinds):
        return found
    question.progress('holding out less, since something begins there')
    less = found.recordings.less_held_out
    other = _settled(_search(less, question), question)
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


def _search(recordings: Recordings, question: Question) -> Found:
    """Search in recordings that are taken as they are."""
    return _found(_begun(recordings, question), question)


def _divided(recordings: Recordings) -> tuple[tuple[Stretch, ...], tuple[Stretch, ...]]:
    """Return what is fitted and what is held out, if anything follows from these."""
    fitted, held_out = recordings.divided
    check(fitted, held_out)
    return fitted, held_out


def _begun(recordings: Recordings, question: Question) -> Begun:
    """Recalibrate the declared model, and fit the noise model to it."""
    fitted, held_out = _divided(recordings)
    question.progress('calibrating the declared model')
    recalibrated = calibrate(Space(question.declared, ()), fitted)
    fitted = restarted(recalibrated.model, fitted)
    question.progress('fitting the noise model')
    near = fit_prediction(recalibrated.space, fitted, recalibrated.u, FIRST_GAINS)
    base = shaken(near)
    # One-step errors have fewer local minima: where they lead is one more start.
    again = fit_simulation(base.space, fitted, base.u)
    recalibrated = min(recalibrated, again, key=simulation_error)
    return Begun(recordings, held_out, recalibrated, base)


def _found(begun: Begun, question: Question) -> Found:
    """Find the structure, with the wheels of each run where a ripple says that they stood."""
    found = _doubted(begun, question)
    recordings = standing(found)
    if recordings is None:
        return found
    question.progress('letting wheels begin where a ripple says that they stand')
    other = _doubted(_begun(recordings, question), question)
    return other if WheelRipple.name in other.names else found


def _doubted(begun: Begun, question: Question) -> Found:
    """Find the structure, and doubt what was found."""
    selection = select(begun.base, question.kinds, begun.held_out, question.progress)
    question.progress('looking for structure that is left')
    doubted = doubt(Seen(selection, begun.held_out))
    return Found(begun.recordings, begun.held_out, begun.recalibrated, selection, *doubted)
