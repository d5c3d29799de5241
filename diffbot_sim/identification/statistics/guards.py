"""How sure an answer must be: the same for a name and for a force that has none."""

import numpy as np
from scipy import stats

# Three guards must agree. The likelihood ratio, corrected for the number tried, guards against
# chance; the block test against disturbances that are no white noise; the gain in data that it
# was not fitted to, held out or other parts of the runs, against fitting those.
LIKELIHOOD_LEVEL, BLOCK_LEVEL, ELSEWHERE_LEVEL = 1e-3, 1e-2, 0.05
# Of the last two neither may be above this, and together they may not be above what they are at
# their levels: where one is beyond all doubt, the other need not be so strict.
EITHER_LEVEL = 0.05
BOTH_LEVEL = float(stats.combine_pvalues([BLOCK_LEVEL, ELSEWHERE_LEVEL]).pvalue)

# Data whose gain is as likely by chance as this rather speak against what they should confirm.
AGAINST = 0.5


def is_chance(p_value: float, tried: int) -> bool:
    """Say whether chance may explain as much, with so many tried."""
    return p_value * tried > LIKELIHOOD_LEVEL


def may_be_chance(p_value: float, delta_bic: float, tried: int) -> bool:
    """Say whether the likelihood allows something to be chance, with so many tried."""
    return is_chance(p_value, tried) or delta_bic <= 0.0


def best_look(*chances: float) -> float:
    """Return the chance of the least of these chances: who looks often sees more."""
    return min(1.0, len(chances) * min(chances, default=1.0))


def lasting(p_block: float, elsewhere: float) -> bool:
    """Say whether something is neither a passing disturbance nor a fit to one: Fisher's method.

    elsewhere: the chance of what it predicts of data that it was not fitted to.
    """
    if max(p_block, elsewhere) > EITHER_LEVEL:
        return False
    both = np.maximum([p_block, elsewhere], np.finfo(float).tiny)
    return bool(stats.combine_pvalues(both).pvalue <= BOTH_LEVEL)
