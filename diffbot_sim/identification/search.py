"""The search: from recordings and a declared model to a structure that explains them."""

from dataclasses import replace
from functools import partial

from diffbot_sim.errors import DataError
from diffbot_sim.identification.finding import (
    Question,
    fitted_and_held_out,
    found_in,
    settled,
)
from diffbot_sim.identification.fitting.units import within_reach
from diffbot_sim.identification.found import Found
from diffbot_sim.identification.free_forms.otherwise import moves_otherwise
from diffbot_sim.identification.later import sets_in_later
from diffbot_sim.identification.odd_ones import denied_by, odd_among
from diffbot_sim.identification.recordings.lateness import timely
from diffbot_sim.identification.recordings.noiseless import odometry_noise, with_noise
from diffbot_sim.identification.recordings.recordings import Recordings
from diffbot_sim.identification.retimed import allowing_a_lead, doubting_lateness, timed
from diffbot_sim.identification.simulating import is_integrators, without_worsening
from diffbot_sim.records import Run


def search(recordings: Recordings, question: Question) -> Found:
    """Search the structures made of these effects.

    Asks, too, whether twists or forces are stamped late, and what begins where runs are held out.
    What is left of recordings without noise may be the integrator of a simulator, and hide what
    is missing: then they are searched again as a good odometry would have told them.
    Raises DataError where the runs are too short or do not move, or a number of the declared
    robot is in another unit.
    """
    fitted, _ = fitted_and_held_out(recordings)
    # What is declared stays the same, however the runs are taken or divided.
    question = replace(question, declared=within_reach(question.declared, fitted))
    found = _answered(recordings, question)
    noise = odometry_noise(question.declared.half_separation)
    if not is_integrators(found, noise):
        return found
    question.progress('adding the noise of a good odometry')
    # What is taken from a pose would be so again, and leave the noise behind.
    noisy = recordings.each(timely).each(partial(with_noise, noise=noise))
    return replace(_answered(noisy, question), noisy=noisy)


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
    found = settled(timed(recordings, question), question)
    found = without_worsening(_begun_later(allowing_a_lead(found, question), question))
    return doubting_lateness(found)


def _begun_later(found: Found, question: Question) -> Found:
    """Search again with less held out, where something seems to begin in that alone."""
    if not _begins_later(found, question):
        return found
    question.progress('holding out less, since something begins there')
    less = found.recordings.less_held_out
    other = settled(found_in(less, question), question)
    if other.unexplained or other.names <= found.names:
        return found
    return other.timed_like(found)


def _begins_later(found: Found, question: Question) -> bool:
    final = found.selection.final
    if found.recordings.validate or not found.recordings.allow_less_held_out:
        return False
    if found.unexplained is not None:
        return moves_otherwise(final, found.held_out) is not None
    return sets_in_later(final, found.recordings, question.kinds, question.progress)
