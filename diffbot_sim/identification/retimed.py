"""The search again, where twists or forces prove to be of other moments than their stamps."""

from dataclasses import replace
from functools import partial

import numpy as np

from diffbot_sim.identification.finding import (
    Question,
    begun_with,
    found_from,
    found_in,
    found_still,
    settled,
    tried_first,
    tried_next,
)
from diffbot_sim.identification.fitting.coordinates import Space
from diffbot_sim.identification.fitting.filter_fits import Ended
from diffbot_sim.identification.fitting.filtering import Likelier, filter_behind
from diffbot_sim.identification.fitting.fit import Fit, fit_prediction
from diffbot_sim.identification.fitting.second_order import filter_seen_at_rest, with_structure
from diffbot_sim.identification.found import Begun, Found
from diffbot_sim.identification.leading import lead_of
from diffbot_sim.identification.older import (
    Ages,
    Older,
    is_beyond_doubt,
    is_taken,
    lead_of_means,
)
from diffbot_sim.identification.recordings.acting import acted_before
from diffbot_sim.identification.recordings.filters import Filter, unfiltered
from diffbot_sim.identification.recordings.lateness import LATE_EFFECTS, timely
from diffbot_sim.identification.recordings.recordings import Recordings
from diffbot_sim.identification.recordings.stretches import thin
from diffbot_sim.identification.selection.trials import OUTDONE

# What a force depends on where more of the twists is late than was allowed for.
PAST_OF_COMMANDS = ('past_force', 'force_change')
# Filters that delay twists alike, within this share of an interval, are one.
ALIKE = 0.03
# Fits whose deviances differ by less than this are of one minimum.
AS_MUCH = 1.0


def timed(recordings: Recordings, question: Question) -> Found:
    """Search, and search again where twists may be older than their stamps, or filtered.

    Where they are older beyond doubt already for the declared model, that is searched first: most
    often nothing else needs to be.
    """
    begun = begun_with(recordings.each(timely), question)
    seen = filter_seen_at_rest(begun.recalibrated, question.kinds)
    if seen is not None:
        return _undoing_seen(seen, begun.recordings, question)
    taken = _Taken(begun.recordings, question)
    older = Ages(begun.base, begun.recordings).beyond_doubt(question.kinds)
    if older is not None:
        found = taken.as_older(older)
        if is_beyond_doubt(older, found.selection.final, begun.recordings, question.kinds):
            return found
    path, filters = tried_first(begun, question), _Filters()
    first = path[0].best
    if first is not None and filters.behind(first) is not None:
        path = tried_next(begun, path, question)
        filtered = _filtered_beyond_doubt(first, path[-1].best, filters, begun, question)
        if filtered is not None:
            return filtered
    return _held_against_older(found_from(begun, path, question), taken, filters, question)


class _Filters:
    """The filter behind each structure: looked for when it is asked for, and once."""

    def __init__(self) -> None:
        self._told = list[tuple[Fit, Likelier | None]]()

    def behind(self, fit: Fit) -> Likelier | None:
        """Return the filter that explains more than an effect that is late, if there is one."""
        told = next((told for told in self._told if _alike(told[0], fit)), None)
        if told is None:
            told = fit, filter_behind(fit)
            self._told.append(told)
        return told[1]


def _alike(one: Fit, other: Fit) -> bool:
    """Say whether two fits of the same runs are of one structure, and explain as much."""
    fall = one.deviance(other.sigma) - other.deviance(other.sigma)
    return one.space == other.space and abs(fall) < AS_MUCH


class _Taken:
    """What is found in twists that are taken as older: searched when it is asked for, and once."""

    def __init__(self, recordings: Recordings, question: Question) -> None:
        self._recordings, self._question = recordings, question
        self._found = dict[Older, Found]()

    def as_older(self, older: Older) -> Found:
        """Return what is found where this of the twists is older than its stamps."""
        if older not in self._found:
            self._question.progress(f'taking {older.what} for means since the sample before')
            taken = self._recordings.each(older.taken)
            self._found[older] = found_in(taken, self._question)
        return self._found[older]


def _held_against_older(
    found: Found, taken: _Taken, filters: _Filters, question: Question
) -> Found:
    """Hold what was found against searches in twists that are older, or went through a filter."""
    # Doubt may have withdrawn a name for what late twists left beside it.
    first = found.undoubted.final
    ages, behind = Ages(first, found.recordings), filters.behind(first)
    unexplained = 0.0 if found.unexplained is None else found.unexplained.worth
    for older in ages.likely if found.says_something else ():
        if behind is not None and _outdoes(behind, first, ages, older):
            continue
        other = taken.as_older(older)
        ends = (other.undoubted.final, ages.timely(older))
        if any(is_taken(older, first, end, unexplained) for end in ends):
            return other
        lead = max(lead_of_means(older, first, end, unexplained) for end in ends)
        if lead > 0.0:
            return _taken_as_led(other.recordings, lead, question)
    unfiltered = found if behind is None else _unfiltered(found, behind, question)
    return replace(unfiltered, undecided=ages.is_undecided)


def _outdoes(behind: Likelier, fit: Fit, ages: Ages, older: Older) -> bool:
    """Say whether a filter explains more of what a fit leaves than twists that are older do."""
    return all(behind.outdoes(fit, other) for other in ages.fits(older))


def _filtered_beyond_doubt(
    first: Fit, second: Fit | None, filters: _Filters, begun: Begun, question: Question
) -> Found | None:
    """Search where the filter that the first effect to enter stands for is undone.

    Nothing else needs to be searched if it is there beside the second effect, too, without which
    a late robot may look like that, means explain less, nothing is unexplained then, and the
    filter stands up to what is found.
    """
    behind = filters.behind(first)
    if behind is None or (second is not None and filters.behind(second) is None):
        return None
    ages = Ages(first, begun.recordings)
    if not all(_outdoes(behind, first, ages, older) for older in ages.likely):
        return None
    found = _undoing(behind.filter, begun.recordings, question)
    if found.unexplained or not _is_of_filter(first, found.undoubted.final):
        return None
    return found


def _is_of_filter(first: Fit, final: Fit) -> bool:
    """Say whether a late effect, the last of a first fit, tells of a filter beside others, too.

    final: what was found on twists that went through none.
    """
    if not final.space.kinds:
        return True
    late, space, start = first.space.kinds[-1], final.space, final.u
    if late not in space.kinds:
        space = Space(space.declared, (*space.kinds, late))
        start = np.append(start, first.u[first.space.places(late.name)])
    beside = fit_prediction(space, first.stretches, start, first.gains)
    return filter_behind(beside) is not None


def _unfiltered(found: Found, behind: Likelier, question: Question) -> Found:
    """Search again where what is left of a filter may be held against the names found."""
    other = _undoing(behind.filter, found.recordings, question)
    # What is undone must not bring about what was not there, and speaks as loudly.
    if other.unexplained and not found.unexplained and other.unexplained.worth > behind.worth:
        return found
    return other


def _undoing_seen(seen: Ended, recordings: Recordings, question: Question) -> Found:
    """Search where a filter is undone, and again where what is found tells that it is another."""
    found = _undoing(seen.filter, recordings, question)
    again = with_structure(seen, found.undoubted.final)
    if abs(again.delay - seen.delay) < ALIKE * again.structure.interval:
        return found
    return _undoing(again.filter, recordings, question)


def _undoing(behind: Filter, recordings: Recordings, question: Question) -> Found:
    question.progress('undoing a filter of the twists')
    # Of the samples that were looked at: one that counts samples is of these.
    undone = recordings.each(thin).each(partial(unfiltered, behind=behind))
    return replace(found_in(undone, question), behind=behind)


def doubting_lateness(found: Found) -> Found:
    """Withdraw what makes a robot late behind a filter where the past of commands matters besides.

    Then the filter is of another kind than that which was undone, and may be all that is late.
    """
    left = found.unexplained
    if found.behind is None or left is None or left.variable not in PAST_OF_COMMANDS:
        return found
    for name in LATE_EFFECTS:
        if name in found.names:
            less = found.selection.withdrawn(name, found.held_out, OUTDONE)
            found = replace(found, selection=less)
    return found


def allowing_a_lead(found: Found, question: Question) -> Found:
    """Search again where forces act before their stamps, if that leaves less to be told."""
    if found.lead > 0.0 or not found.says_something:
        return found
    lead = lead_of(found.undoubted.final)
    if lead <= 0.0:
        return found
    # Where nothing else is to be told no other names are looked for.
    still = _told_as_led(found, lead, question) if found.tells_all else None
    if still is not None:
        return still
    other = settled(_taken_as_led(found.recordings, lead, question), question)
    if other.unexplained or not (found.unexplained or other.names <= found.names):
        return found
    return replace(other.timed_like(found), lead=lead)


def _told_as_led(found: Found, lead: float, question: Question) -> Found | None:
    """Return what was found with forces that are taken to act earlier, if all names stand then."""
    still = found_still(found, _led(found.recordings, lead, question), question)
    return None if still is None else replace(still, lead=lead)


def _taken_as_led(recordings: Recordings, lead: float, question: Question) -> Found:
    """Search in recordings whose forces are taken to act so long before their stamps [s]."""
    return replace(found_in(_led(recordings, lead, question), question), lead=lead)


def _led(recordings: Recordings, lead: float, question: Question) -> Recordings:
    question.progress('taking forces for older than their stamps')
    return recordings.each(partial(acted_before, lead=lead))
