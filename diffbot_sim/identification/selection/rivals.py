"""Rivals: structures that are fitted for as long as they may come up to another one."""

from dataclasses import replace
from functools import partial
from math import inf

import numpy as np

from diffbot_sim.identification.fitting.fit import ROUNDS, Fit, fit_prediction
from diffbot_sim.identification.selection.evidence import delta_bic
from diffbot_sim.identification.statistics.gains import block_gain
from diffbot_sim.identification.statistics.guards import BLOCK_LEVEL, VERY_STRONG
from diffbot_sim.identification.statistics.parallel import side_by_side
from diffbot_sim.identification.statistics.robust import huber

# What is behind by less than this, and more than that, is told from the best only if parts of the
# runs agree: a law that is a little off near rest, as many are, may decide as much at a few stops.
CONTESTED = 25.0
# A rival that makes up for less than this share of what it lacks, in a round, will not come up.
CATCHING_UP = 0.1


def comes_up(rival: Fit, best: Fit) -> bool:
    """Fit a rival that was approached for as long as it may come up to the best; say if it did.

    Its own noise model may follow what is missing, so that nothing is left to catch up with: so
    it is fitted from the best's, too.
    """
    begun = [replace(rival, gains=gains) for gains in (rival.gains, best.gains)]
    return any(side_by_side(partial(_catches_up, best), begun))


def _catches_up(best: Fit, rival: Fit) -> bool:
    behind = inf
    for _ in range(ROUNDS):
        rival = fit_prediction(rival.space, rival.stretches, rival.u, rival.gains, rounds=1)
        before, behind = behind, delta_bic(rival, best)
        if behind < VERY_STRONG:
            return True
        if before - behind < CATCHING_UP * behind:
            break
    return not is_told_apart(rival, best)


def is_told_apart(rival: Fit, best: Fit) -> bool:
    """Say whether a rival is clearly behind the best: far, or all along the runs.

    That is what Vuong (1989) asks of structures that are not nested, but by ranks.
    """
    behind = delta_bic(rival, best)
    if not VERY_STRONG <= behind < CONTESTED:
        return behind >= CONTESTED
    sigma = np.minimum(rival.sigma, best.sigma)
    worse, less = (huber(fit.over(sigma)).sum(axis=1) for fit in (rival, best))
    price = best.price(len(rival.u) - len(best.u)) / len(less)
    return block_gain(worse - less + price)[1] <= BLOCK_LEVEL
