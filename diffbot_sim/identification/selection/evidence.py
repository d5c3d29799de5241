"""How much a larger structure is worth: in sample, robust to serial correlation, and held out."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import inf, isnan, nan

import numpy as np
from scipy import stats

from diffbot_sim.identification.fitting.fit import Fit, whitened
from diffbot_sim.identification.recordings.start import restarted
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.statistics.blocks import informative_blocks, sandwich, wald_p
from diffbot_sim.identification.statistics.gains import block_gain, folds_chance
from diffbot_sim.identification.statistics.guards import AGAINST, best_look, elsewhere
from diffbot_sim.identification.statistics.memory import fall_of_deviance, falls_beyond_past
from diffbot_sim.identification.statistics.projection import apart
from diffbot_sim.identification.statistics.robust import huber
from diffbot_sim.records import Array

# Errors of counts take back more of the last one than this; by such a share they may weigh more,
# while they are better foreseen, and be no worse.
COUNTED, MUCH_LARGER = -0.25, 0.05
# With fewer degrees of freedom the spread over blocks is no measure of chance.
FEWEST = 8


@dataclass(frozen=True)
class Evidence:
    """A structure against the smaller one inside it.

    delta_bic: fall of the BIC; p_value: likelihood ratio; p_block: Wald test with the covariance
    of blocks, nan where too few know of it; held_out_gain: fall of the mean half squared
    error per held-out sample; p_held_out: the chance of that, by signed ranks of blocks; p_folds:
    the same of parts of the runs predicted from the others, nan where they prove nothing.
    """

    delta_bic: float
    p_value: float
    p_block: float
    held_out_gain: float
    p_held_out: float
    p_folds: float

    @property
    def p_elsewhere(self) -> float:
        """The chance of what it predicts of data that it was not fitted to."""
        return elsewhere(self.p_held_out, self.p_folds)

    @property
    def is_refuted(self) -> bool:
        """Whether held-out data speak against it: most of them lose by it."""
        return self.held_out_gain < 0.0 and self.p_held_out >= AGAINST

    @property
    def is_contradicted(self) -> bool:
        """Whether held-out data and other parts of the runs would rather do without it."""
        return all(isnan(p) or p >= AGAINST for p in (self.p_held_out, self.p_folds))

    def of_best(self, looks: int) -> 'Evidence':
        """Return the evidence for a structure that was the best of so many."""
        chances = (self.p_value, self.p_block, self.p_folds)
        p_value, p_block, p_folds = np.minimum(1.0, looks * np.array(chances)).tolist()
        return replace(self, p_value=p_value, p_block=p_block, p_folds=p_folds)


def compare(small: Fit, large: Fit, held_out: Sequence[Stretch]) -> Evidence:
    """Weigh a large fit against a small one nested in it."""
    added = len(large.u) - len(small.u)
    ratio = likelihood_ratio(small, large)
    gain, chance = held_out_gain(small, large, held_out)
    amounts, shapes = _added(small, large)
    of_time = _adds_law_of_time(small, large)
    return Evidence(
        delta_bic=ratio - large.price(added),
        p_value=float(stats.chi2.sf(ratio, added)),
        p_block=nan if _known_to_few(large, amounts) else wald(large, amounts, shapes),
        held_out_gain=gain,
        p_held_out=chance,
        p_folds=nan if of_time else _folds_chance(large, amounts, shapes),
    )


def likelihood_ratio(small: Fit, large: Fit) -> float:
    """Return by how much the deviance falls from one fit to another, no less than nothing."""
    return fall_of_deviance(small.over(large.sigma), large.whitened)


def _adds_law_of_time(small: Fit, large: Fit) -> bool:
    """Say whether a law was added that must prove right at the end: parts around prove nothing."""
    return any(kind.is_of_time for kind in large.space.kinds if kind not in small.space.kinds)


def _added(small: Fit, large: Fit) -> tuple[list[int], list[int]]:
    """Return where the larger fit has amounts, and shapes, that the smaller one lacks."""
    known = {coordinate.name for coordinate in small.space.coordinates}
    names = [coordinate.name for coordinate in large.space.coordinates]
    added = [i for i, name in enumerate(names) if name not in known]
    shapes = [i for i in added if i in large.space.shapes]
    return [i for i in added if i not in shapes], shapes


def delta_bic(first: Fit, second: Fit) -> float:
    """Return how much lower the second's BIC is than the first's; they need not be nested."""
    sigma = np.minimum(first.sigma, second.sigma)
    fall = first.deviance(sigma) - second.deviance(sigma)
    return fall - second.price(len(second.u) - len(first.u))


def delta_bic_beyond_past(first: Fit, second: Fit) -> float:
    """Return the same where errors may be those of counts, as they are or beyond their past."""
    fall = float(_falls_beyond(first, second).sum())
    return fall - second.price(len(second.u) - len(first.u))


def delta_bic_of_speed(first: Fit, second: Fit) -> float:
    """Return that for what is told of the speed; turn rates need not be the same data."""
    return float(_delta_bics(first, second)[0])


def delta_bic_of_both(first: Fit, second: Fit) -> float:
    """Return that for what is told of speed or turn rate, whichever gains less."""
    return float(_delta_bics(first, second).min())


def _delta_bics(first: Fit, second: Fit) -> Array:
    """Return that for what is told of v, and of ω, shape (2,)."""
    price = (len(second.u) - len(first.u)) * np.log(len(second.whitened))
    return np.asarray(_falls_beyond(first, second) - price)


def _falls_beyond(first: Fit, second: Fit) -> Array:
    """Return by how much less the second's errors of v and ω weigh than the first's.

    As they are, or beyond what their past tells, whichever is more, where they are those of
    counts: each takes back the last one. Fits that take errors as white leave sums of these to
    chance, which weigh hundreds beyond their past; and where a controller hears counts, a late
    robot seems to foresee them as they are. If they are much larger as they are, they are worse
    all the same.
    """
    sigma = np.minimum(first.sigma, second.sigma)
    before, after = first.over(sigma), second.over(sigma)
    weight, beyond = huber(before).sum(axis=0), falls_beyond_past(before, after)
    as_they_are = weight - huber(after).sum(axis=0)
    counted = np.sum(before[1:] * before[:-1], axis=0) < COUNTED * np.sum(before**2, axis=0)
    alike = counted & (as_they_are > -MUCH_LARGER * weight)
    return np.asarray(np.where(alike, np.maximum(beyond, as_they_are), as_they_are))


def held_out_gain(small: Fit, large: Fit, held_out: Sequence[Stretch]) -> tuple[float, float]:
    """Return the mean fall of the held-out loss per sample, and its chance over blocks.

    Watched by the noise model of either fit, whichever shows more: that of the small one may make
    up for what it lacks, that of the large one trusts a model that is a moment late when a wheel
    breaks away. The chance counts both looks.
    """
    begun = [restarted(fit.model, held_out) for fit in (small, large)]
    looks = []
    for gains in (small.gains, large.gains):
        losses = [
            0.5 * huber(whitened(stretches, fit.model, gains, large.sigma)).sum(axis=1)
            for fit, stretches in zip((small, large), begun, strict=True)
        ]
        looks.append(block_gain(losses[0] - losses[1]))
    gain, _ = min(looks, key=lambda look: inf if isnan(look[1]) else look[1])
    return gain, best_look(*(chance for _, chance in looks))


def _folds_chance(fit: Fit, amounts: Sequence[int], shapes: Sequence[int]) -> float:
    """Return the chance of what some amounts predict of each part of the runs from others.

    To first order around the fit, all else adapted to the whole; shapes are held.
    """
    return folds_chance(*beside_others(fit, amounts, shapes))


def beside_others(
    fit: Fit, amounts: Sequence[int], shapes: Sequence[int] = ()
) -> tuple[Array, Array]:
    """Return errors as they are without some amounts, (2 n,), and their derivatives, (2 n, q).

    To first order around the fit; of both is taken out what else is free but the shapes.
    """
    free = np.delete(fit.slopes, [*amounts, *shapes], axis=1)
    return apart(fit.whitened, free, fit.slopes[:, amounts], fit.departure[amounts])


def wald(fit: Fit, amounts: Sequence[int], shapes: Sequence[int]) -> float:
    """Return the block-robust p-value of some amounts being at their prior (neutral).

    shapes: what they were found with, and is held: without an amount it means nothing, and beside
    it the same data may allow twice the amount twice as late. How many were tried is counted by
    `Evidence.of_best`.
    """
    slopes = fit.slopes
    kept = np.delete(np.arange(slopes.shape[1]), shapes)
    chosen = np.searchsorted(kept, amounts)
    spread = sandwich(slopes[:, kept], fit.whitened.ravel(), fit.prior_information[kept])
    blocks = informative_blocks(slopes[:, amounts])
    return wald_p(fit.departure[amounts], spread[np.ix_(chosen, chosen)], blocks)


def rise_without(fit: Fit, amounts: Sequence[int]) -> float:
    """Return by how much the deviance rises where some amounts are neutral, by its curvature.

    Too much where a noise model would follow what they no longer explain; never too little.
    """
    spread = np.linalg.pinv(fit.slopes.T @ fit.slopes + np.diag(fit.prior_information))
    departure = fit.departure[amounts]
    return float(departure @ np.linalg.pinv(spread[np.ix_(amounts, amounts)]) @ departure)


def _known_to_few(fit: Fit, amounts: Sequence[int]) -> bool:
    """Say whether too few blocks know of some amounts to tell what is chance."""
    return informative_blocks(fit.slopes[:, amounts]) < len(amounts) + FEWEST
