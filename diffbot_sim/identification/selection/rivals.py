"""Rivals: structures that are fitted for as long as they may come up to another one."""

from dataclasses import replace
from math import inf

from diffbot_sim.identification.fitting.fit import ROUNDS, Fit, fit_prediction
from diffbot_sim.identification.selection.evidence import delta_bic
from diffbot_sim.identification.statistics.guards import VERY_STRONG

# A rival that makes up for less than this share of what it lacks, in a round, will not come up.
CATCHING_UP = 0.1


def comes_up(rival: Fit, best: Fit) -> bool:
    """Fit a rival that was approached for as long as it may come up to the best; say if it did.

    Its own noise model may follow what is missing, so that nothing is left to catch up with: so
    it is fitted from the best's, too.
    """
    begun = (replace(rival, gains=gains) for gains in (rival.gains, best.gains))
    return any(_catches_up(it, best) for it in begun)


def _catches_up(rival: Fit, best: Fit) -> bool:
    behind = inf
    for _ in range(ROUNDS):
        rival = fit_prediction(rival.space, rival.stretches, rival.u, rival.gains, rounds=1)
        before, behind = behind, delta_bic(rival, best)
        if behind < VERY_STRONG:
            return True
        if before - behind < CATCHING_UP * behind:
            return False
    return False
