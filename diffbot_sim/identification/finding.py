"""From recordings, taken as they are, to the structure that explains them."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from diffbot_sim.identification.allowing import allowing_friction
from diffbot_sim.identification.doubt import Seen, doubt
from diffbot_sim.identification.fitting.calibration import calibrate, simulation_error
from diffbot_sim.identification.fitting.coordinates import Space
from diffbot_sim.identification.fitting.fit import FIRST_GAINS, fit_prediction, fit_simulation
from diffbot_sim.identification.fitting.shaking import shaken
from diffbot_sim.identification.found import Begun, Found
from diffbot_sim.identification.recordings.checks import check
from diffbot_sim.identification.recordings.recordings import Recordings
from diffbot_sim.identification.recordings.start import restarted
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.selection.stepwise import (
    Tried,
    forward,
    one_more,
    select,
    tried_on,
)
from diffbot_sim.identification.selection.trials import Progress
from diffbot_sim.identification.standing_wheels import standing
from diffbot_sim.physics.effects import Effect
from diffbot_sim.physics.effects.wheel_ripple import WheelRipple
from diffbot_sim.physics.model import Model


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


def found_in(recordings: Recordings, question: Question) -> Found:
    """Search in recordings that are taken as they are."""
    begun = begun_with(recordings, question)
    return found_from(begun, tried_first(begun, question), question)


def found_still(found: Found, recordings: Recordings, question: Question) -> Found | None:
    """Return the same answer for recordings that are taken otherwise; None if a name falls."""
    begun = begun_with(recordings, question)
    selection = found.selection.fitted_anew(begun.base, recordings, begun.held_out)
    if not selection.stands(len(question.kinds)):
        return None
    return replace(
        found,
        recordings=recordings,
        held_out=begun.held_out,
        recalibrated=begun.recalibrated,
        undoubted=selection,
        selection=selection,
    )


def fitted_and_held_out(recordings: Recordings) -> tuple[tuple[Stretch, ...], tuple[Stretch, ...]]:
    """Return what is fitted and what is held out, if anything follows from these."""
    fitted, held_out = recordings.divided
    check(fitted, held_out)
    return fitted, held_out


def begun_with(recordings: Recordings, question: Question) -> Begun:
    """Recalibrate the declared model, and fit the noise model to it."""
    fitted, held_out = fitted_and_held_out(recordings)
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


def tried_first(begun: Begun, question: Question) -> Sequence[Tried]:
    """Try every effect on top of the declared model: the path of the search begins there."""
    return (tried_on(begun.base, question.kinds, begun.held_out, question.progress),)


def tried_next(begun: Begun, path: Sequence[Tried], question: Question) -> Sequence[Tried]:
    """Try every effect on top of what enters next, if anything does."""
    return one_more(path, question.kinds, begun.held_out, question.progress)


def found_from(begun: Begun, path: Sequence[Tried], question: Question) -> Found:
    """Find the structure, with the wheels of each run where a ripple says that they stood.

    path: where the forward search begins, or as far as it went.
    """
    found = _doubted(begun, path, question)
    recordings = standing(found)
    if recordings is None:
        return found
    question.progress('letting wheels begin where a ripple says that they stand')
    again = begun_with(recordings, question)
    other = _doubted(again, tried_first(again, question), question)
    return other if WheelRipple.name in other.names else found


def _doubted(begun: Begun, path: Sequence[Tried], question: Question) -> Found:
    """Find the structure, and doubt what was found."""
    grown = forward(path, question.kinds, begun.held_out, question.progress)
    selection = select(grown, question.kinds, begun.held_out, question.progress)
    question.progress('looking for structure that is left')
    doubted = doubt(Seen(selection, begun.held_out))
    return Found(begun.recordings, begun.held_out, begun.recalibrated, selection, *doubted)


def settled(found: Found, question: Question) -> Found:
    """Allow for friction near rest where something would be unexplained without that."""
    if found.unexplained is None:
        return found
    question.progress('allowing for friction near rest')
    return allowing_friction(found)


def recalibrated(recordings: Recordings, question: Question) -> Found:
    """Recalibrate the declared model, and look for nothing that it lacks."""
    begun = begun_with(recordings, question)
    nothing = replace(question, known=())
    alone = select(tried_first(begun, nothing), (), begun.held_out, question.progress)
    return Found(begun.recordings, begun.held_out, begun.recalibrated, alone, alone, None)
