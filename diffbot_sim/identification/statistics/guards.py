"""How sure an answer must be: the same for a name and for a force that has none."""

from collections.abc import Iterable
from math import inf, isnan, log, nan

import numpy as np
from scipy import stats

from diffbot_sim.identification.statistics.gains import RANKED

# Three guards must agree. The likelihood ratio, corrected for the number tried, guards against
# chance; the block test against disturbances that are no white noise; the gain in data that it
# was not fitted to, held out or other parts of the runs, against fitting those.
LIKELIHOOD_LEVEL, BLOCK_LEVEL, ELSEWHERE_LEVEL = 1e-3, 1e-2, 0.05
# Of the last two neither may be above this, and together they may not be above what they are at
# their levels: where one is beyond all doubt, the other need not be so strict.
EITHER_LEVEL = 0.05
BOTH_LEVEL = float(stats.combine_pvalues([BLOCK_LEVEL, ELSEWHERE_LEVEL]).pvalue)

# Held-out data are three tenths of a run, or less, and know about half as much as parts of the
# rest of it.
WEIGHTS = (1.0, 2.0)
# Signed ranks of so many blocks are never surer than this.
SUREST = 2.0**-RANKED

# What lowers the BIC by less tells structures apart by no more than chance might: above it Kass
# and Raftery (1995) call evidence very strong.
VERY_STRONG = 10.0

# A force that lowers the BIC by more where it was fitted was there, though held-out data may lack
# it: on rough floors none did by more than 14 on any of 102 clean robots. By so much more that it
# need not be foreseen even by parts of the same data: a brake that lets go late now and then.
FAR_BEYOND, BEYOND_ALL = 25.0, 100.0

# A chance that is as good as none.
IMPOSSIBLE = 1e-300

# Data whose gain is as likely by chance as this rather speak against what they should confirm.
AGAINST = 0.5


def chance_of_fall(fall: float, numbers: int, shapes: float = 1.0) -> float:
    """Return the chance that so many numbers lower the deviance so, in the best of some shapes."""
    return min(1.0, shapes * float(stats.chi2.sf(fall, numbers)))


def is_chance(p_value: float, tried: int) -> bool:
    """Say whether chance may explain as much, with so many tried."""
    return p_value * tried > LIKELIHOOD_LEVEL


def may_be_chance(p_value: float, delta_bic: float, tried: int) -> bool:
    """Say whether the likelihood allows something to be chance, with so many tried."""
    return is_chance(p_value, tried) or delta_bic <= 0.0


def weight(chances: Iterable[float]) -> float:
    """Return what chances weigh together, as falls of the deviance do: Fisher's method."""
    return -2.0 * sum(log(max(chance, IMPOSSIBLE)) for chance in chances)


def best_look(*chances: float) -> float:
    """Return the chance of the least of these chances: who looks often sees more.

    Those that prove nothing (nan) are no looks; without any other it is nan.
    """
    told = [chance for chance in chances if not isnan(chance)]
    return 1.0 - (1.0 - min(told)) ** len(told) if told else nan


def elsewhere(held_out: float, parts: float) -> float:
    """Return the chance of what two witnesses say: Stouffer's method.

    held_out: held-out data; parts: parts of the runs, predicted from others. nan where one proves
    nothing. They speak of the same fit, so two count as two looks.
    """
    pairs = zip((held_out, parts), WEIGHTS, strict=True)
    known = [(chance, weight) for chance, weight in pairs if not isnan(chance)]
    if not known:
        return 1.0
    chances, weights = zip(*known, strict=True)
    chances = np.clip(chances, SUREST, 1.0 - SUREST)
    chance = float(stats.combine_pvalues(chances, 'stouffer', weights).pvalue)
    return best_look(*[chance] * len(known))


def lasting(p_block: float, p_elsewhere: float) -> bool:
    """Say whether something is neither a passing disturbance nor a fit to one: Fisher's method.

    p_block: nan where too few blocks know of it to tell: then the other must be as sure as
    both; p_elsewhere: the chance of what it predicts of data that it was not fitted to.
    """
    if isnan(p_block):
        return p_elsewhere <= BOTH_LEVEL
    if max(p_block, p_elsewhere) > EITHER_LEVEL:
        return False
    both = np.maximum([p_block, p_elsewhere], np.finfo(float).tiny)
    return bool(stats.combine_pvalues(both).pvalue <= BOTH_LEVEL)


def least_worth(p_block: float, p_folds: float, p_held_out: float) -> float:
    """Return by what a force must lower the BIC to be believed, infinite if other data deny it.

    p_folds: the chance of what parts of the runs tell of others; nan where they prove nothing.
    """
    p_elsewhere = elsewhere(p_held_out, p_folds)
    if lasting(p_block, p_elsewhere):
        return 0.0
    # What was sure all along the fitted data may have ended since.
    if not isnan(p_folds) and lasting(p_block, p_folds):
        return FAR_BEYOND
    return BEYOND_ALL if p_block <= BLOCK_LEVEL and p_elsewhere <= AGAINST else inf
