"""How sure least squares are whose errors are correlated: what blocks of samples say."""

import numpy as np
from scipy import stats

from diffbot_sim.identification.statistics.robust import influence
from diffbot_sim.records import Array

# Blocks that count as independent; each is much longer than any correlation of innovations.
BLOCKS = 40


def sandwich(jacobian: Array, errors: Array, known: Array) -> Array:
    """Return the block-robust covariance of a least-squares fit.

    jacobian, shape (n, p); errors, shape (n,); known: what a weak prior knows of each coordinate,
    the inverse variances, shape (p,).
    """
    bread = np.linalg.pinv(jacobian.T @ jacobian + np.diag(known))
    scores = block_scores(jacobian, errors)
    return np.asarray(bread @ (scores.T @ scores * BLOCKS / (BLOCKS - 1)) @ bread)


def jackknife(jacobian: Array, errors: Array, known: Array, blocks: int = BLOCKS) -> Array:
    """Return the covariance of a least-squares fit from fits that lack a block each.

    To first order. jacobian, shape (n, 2, p); errors, shape (n, 2); known as for `sandwich`, which
    shrinks as parameters use up the blocks, and this does not: CR3 of MacKinnon, Nielsen, Webb
    (2023). What one block alone tells is wide. What none tells was guessed, and is as uncertain
    as the guess: the prior adds its own share.
    """
    prior = np.diag(known)
    parts = [np.tensordot(j, j, ((0, 1), (0, 1))) for j in np.array_split(jacobian, blocks)]
    whole = sum(parts, prior)
    scores = block_scores(jacobian, errors, blocks)
    moved = [np.linalg.solve(whole - p, s) for p, s in zip(parts, scores, strict=True)]
    bread = np.linalg.inv(whole)
    guessed = bread @ prior @ bread
    return np.asarray(np.transpose(moved) @ moved * (blocks - 1) / blocks + guessed)


def block_scores(jacobian: Array, errors: Array, blocks: int = BLOCKS) -> Array:
    """Return J'e of each block, shape (blocks, p): jacobian (n, ..., p), errors (n, ...)."""
    each = (influence(errors)[..., None] * jacobian).reshape(len(errors), -1, jacobian.shape[-1])
    places = np.arange(blocks)
    # Where array_split cuts: the first blocks have what is left over.
    begins = len(errors) // blocks * places + np.minimum(places, len(errors) % blocks)
    return np.asarray(np.add.reduceat(each.sum(axis=1), begins))


def informative_blocks(sensitivity: Array) -> float:
    """Return how many blocks carry what is known of the columns, the richest column deciding.

    A few seconds of a run may hold all of it; then a spread over blocks is worth little. What a
    tenth of a block exceeds counts, since who drives steadily shows little of a mass most of the
    time: one stop, a sample early or late, must not outweigh all the rest.
    """
    parts = np.array_split(np.abs(sensitivity), BLOCKS)
    weights = np.array([np.quantile(part, 0.9, axis=0) for part in parts]) + 1e-30
    return float(np.max(weights.sum(axis=0) ** 2 / np.sum(weights**2, axis=0)))


def wald_p(departure: Array, spread: Array, blocks: float = BLOCKS) -> float:
    """Return the p-value of a departure whose covariance comes from so many blocks."""
    count = len(departure)
    if blocks < count + 1.0:
        return 1.0
    w = float(departure @ np.linalg.pinv(spread) @ departure)
    return float(stats.f.sf(w / count, count, blocks - count))
