"""What sets in where runs are held out: it is seen there, but fitted only where less is."""

from collections.abc import Sequence

from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.recordings.recordings import Recordings
from diffbot_sim.identification.selection.candidates import on_recordings, refitted
from diffbot_sim.identification.selection.screening import Screen
from diffbot_sim.identification.selection.stepwise import tried_on
from diffbot_sim.identification.selection.trials import Progress
from diffbot_sim.identification.statistics.guards import may_be_chance
from diffbot_sim.physics.effects import Effect


def sets_in_later(
    fit: Fit, recordings: Recordings, kinds: Sequence[type[Effect]], progress: Progress
) -> bool:
    """Say whether an effect that a fit lacks sets in where less is held out.

    It must seem so, and enter beside what was found: a search costs more than to try one.
    kinds: those that may be missing; only those that set in at a moment are asked.
    """
    missing = [k for k in kinds if k.onset is not None and k not in fit.space.kinds]
    if not missing:
        return False
    less = recordings.less_held_out
    screen = Screen(on_recordings(fit, less))
    seeming = [kind for kind in missing if _seems_to_act(screen, kind, len(missing))]
    if not seeming:
        return False
    _, held_out = less.divided
    return tried_on(refitted(screen.fit), seeming, held_out, progress).best is not None


def _seems_to_act(screen: Screen, kind: type[Effect], tried: int) -> bool:
    score = screen.score(kind)
    return not may_be_chance(score.p_value, score.ratio - screen.price(kind), tried)
