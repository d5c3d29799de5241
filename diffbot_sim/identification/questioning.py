"""The search, with what was recorded and what was declared put in question, too."""

from collections.abc import Sequence
from dataclasses import replace
from functools import reduce

from diffbot_sim.identification.contradiction import (
    contradicted,
    explains_better,
    law_is_contradicted,
    resized,
    with_general_law,
)
from diffbot_sim.identification.fitting.coordinates import Space
from diffbot_sim.identification.fitting.wiring import fault_of
from diffbot_sim.identification.following import moved_as_if
from diffbot_sim.identification.found import Found
from diffbot_sim.identification.recordings.recordings import Recordings
from diffbot_sim.identification.result import LAW
from diffbot_sim.identification.search import search
from diffbot_sim.identification.selection.trials import Progress
from diffbot_sim.physics.effects import Effect, laws
from diffbot_sim.physics.model import Model


def searched(
    recordings: Recordings,
    declared: Model,
    kinds: Sequence[type[Effect]] | None,
    progress: Progress,
) -> tuple[Found, tuple[str, ...]]:
    """Search for what the model lacks; return, too, what it had better lack.

    What is wired otherwise than it is told is no matter of effects: then none is looked for.
    """
    progress('looking at sides, signs, units and clocks')
    fault = fault_of(recordings, Space(declared, ()))
    if fault:
        found = search(recordings, declared, (), progress)
        return replace(found, unexplained=moved_as_if(fault, found)), ()
    found = search(recordings, declared, _candidates(declared, kinds), progress)
    return _without_denied(found, recordings, declared, kinds, progress)


def _without_denied(
    found: Found,
    recordings: Recordings,
    declared: Model,
    kinds: Sequence[type[Effect]] | None,
    progress: Progress,
) -> tuple[Found, tuple[str, ...]]:
    """Search again without what is declared and contradicted, if anything is; return what is."""
    denied, law = contradicted(found), law_is_contradicted(found)
    effects = tuple(effect.name for effect in denied)
    names = (*effects, LAW) if law else effects
    if not names:
        return found, ()
    progress(f'doing without the declared {", ".join(names)}')
    lawful = with_general_law(declared) if law else declared
    less = reduce(Model.without, effects, lawful)
    other = search(recordings, less, _candidates(less, kinds), progress)
    if not explains_better(other, found):
        return found, ()
    nearly = resized(lawful, denied, other)
    kept = {effect.name for effect in nearly.effects}
    if kept.intersection(effects):
        progress('recalibrating declared effects')
        other = search(recordings, nearly, _candidates(nearly, kinds), progress)
    return other, tuple(name for name in names if name not in kept)


def _candidates(declared: Model, kinds: Sequence[type[Effect]] | None) -> tuple[type[Effect], ...]:
    """Return the effects to try: what the declared model has is not missing."""
    present = {effect.name for effect in declared.effects}
    chosen = laws().values() if kinds is None else kinds
    return tuple(kind for kind in chosen if kind.name not in present)
