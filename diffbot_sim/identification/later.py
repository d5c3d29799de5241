"""What sets in where runs are held out: it is seen there, but fitted only where less is."""

from collections.abc import Sequence

from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.recordings.recordings import Recordings
from diffbot_sim.identification.selection.candidates import on_recordings
from diffbot_sim.identification.selection.screening import Screen
from diffbot_sim.identification.statistics.guards import may_be_chance
from diffbot_sim.physics.effects import Effect


def sets_in_later(fit: Fit, recordings: Recordings, kinds: Sequence[type[Effect]]) -> bool:
    """Say whether an effect that a fit lacks seems to set in where less is held out.

    kinds: those that may be missing; only those that set in at a moment are asked.
    """
    missing = [k for k in kinds if k.onset is not None and k not in fit.space.kinds]
    if not missing:
        return False
    screen = Screen(on_recordings(fit, recordings.less_held_out))
    return any(_seems_to_act(screen, kind, len(missing)) for kind in missing)


def _seems_to_act(screen: Screen, kind: type[Effect], tried: int) -> bool:
    score = screen.score(kind)
    return not may_be_chance(score.p_value, score.ratio - screen.price(kind), tried)
