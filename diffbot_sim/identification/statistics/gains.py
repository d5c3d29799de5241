"""Whether predictions gain by something: signed ranks over blocks of samples."""

from math import nan

import numpy as np
from scipy import stats

from diffbot_sim.identification.statistics.robust import huber
from diffbot_sim.records import Array

# Blocks of samples whose gains are ranked.
RANKED = 20
# Parts of the runs, and into how many groups of parts they are dealt in turn.
PARTS, FOLDS = 40, 5
# What is known of amounts beforehand, the inverse variance in units of what chance makes of them:
# next to nothing, or that each does some three times as much as chance. That takes less of the
# noise of many for amounts, and hardly changes what a few predict.
NOTHING, THRICE_CHANCE = 1e-6, 0.1
# Largest fall of the loss that one sample of another part may stand for.
MOST_OF_SAMPLE = 4.0


def block_gain(gain: Array) -> tuple[float, float]:
    """Return the mean of gains per sample and the p-value of its being above zero.

    Signed ranks over blocks: a single block with a large gain, or loss, cannot decide. Where
    nothing gains or loses they prove nothing: nan.
    """
    blocks = [block.mean() for block in np.array_split(gain, RANKED)]
    if not np.any(blocks):
        return 0.0, nan
    return float(gain.mean()), float(stats.wilcoxon(blocks, alternative='greater').pvalue)


def chance_of(gain: Array) -> float:
    """Return the chance of gains of samples, shape (n, 2)."""
    # Where a wheel starts or stops a small force decides much: no sample may say more than this.
    return block_gain(np.clip(gain, -MOST_OF_SAMPLE, MOST_OF_SAMPLE).sum(axis=1))[1]


def folds_chance(errors: Array, columns: Array, known: float = NOTHING) -> float:
    """Return the chance of what amounts from other parts of the runs predict of each part.

    errors: whitened, shape (2 n,); columns: their derivatives by the amounts, shape (2 n, q); of
    both is taken out what else is free; known: beforehand, of the amounts. Parts lie between each
    other: where a robot never comes back, or time has gone, the end of a run cannot confirm what
    the beginning says.
    """
    columns = columns / np.maximum(np.linalg.norm(columns, axis=0), 1e-12)
    parts = np.arange(len(errors)) * PARTS // len(errors) % FOLDS
    inside = [(columns[parts == fold], errors[parts == fold]) for fold in range(FOLDS)]
    squares = np.array([c.T @ c for c, _ in inside])
    products = np.array([c.T @ e for c, e in inside])
    gain = np.empty(len(errors))
    for fold, (c, e) in enumerate(inside):
        others = squares.sum(axis=0) - squares[fold] + known * np.eye(columns.shape[1])
        amounts = np.linalg.solve(others, products[fold] - products.sum(axis=0))
        gain[parts == fold] = huber(e) - huber(e + c @ amounts)
    return chance_of(gain.reshape(-1, 2))
