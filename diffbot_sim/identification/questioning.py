"""The search, with what was recorded and what was declared put in question, too."""

from dataclasses import replace
from functools import reduce

from diffbot_sim.identification.contradiction import (
    contradicted,
    explains_better,
    law_is_contradicted,
    resized,
    with_general_law,
)
from diffbot_sim.identification.finding import Question, fitted_and_held_out, recalibrated
from diffbot_sim.identification.fitting.coordinates import Space
from diffbot_sim.identification.fitting.wiring import fault_of
from diffbot_sim.identification.following import moved_as_if
from diffbot_sim.identification.found import Found
from diffbot_sim.identification.recordings.recordings import Recordings
from diffbot_sim.identification.result import LAW
from diffbot_sim.identification.search import search
from diffbot_sim.physics.model import Model


def searched(recordings: Recordings, question: Question) -> tuple[Found, tuple[str, ...]]:
    """Search for what the model lacks; return, too, what it had better lack.

    What is wired otherwise than it is told is no matter of effects: then none is looked for.
    Raises DataError where nothing follows from the recordings.
    """
    fitted_and_held_out(recordings)
    question.progress('looking at sides, signs, units and clocks')
    fault = fault_of(recordings, Space(question.declared, ()))
    if fault:
        found = recalibrated(recordings, question)
        return replace(found, unexplained=moved_as_if(fault, found)), ()
    return _without_denied(search(recordings, question), recordings, question)


def _without_denied(
    found: Found, recordings: Recordings, question: Question
) -> tuple[Found, tuple[str, ...]]:
    """Search again without what is declared and contradicted, if anything is; return what is."""
    denied, law = contradicted(found), law_is_contradicted(found)
    effects = tuple(effect.name for effect in denied)
    names = (*effects, LAW) if law else effects
    if not names:
        return found, ()
    question.progress(f'doing without the declared {", ".join(names)}')
    lawful = with_general_law(question.declared) if law else question.declared
    less = replace(question, declared=reduce(Model.without, effects, lawful))
    other = search(recordings, less)
    if not explains_better(other, found):
        return found, ()
    nearly = resized(lawful, denied, other)
    kept = {effect.name for effect in nearly.effects}
    if kept.intersection(effects):
        question.progress('recalibrating declared effects')
        other = search(recordings, replace(question, declared=nearly))
    return other, tuple(name for name in names if name not in kept)
