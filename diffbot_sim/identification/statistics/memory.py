"""What past errors tell of the next one: a noise model beyond that of the predictor.

Where a controller hears the odometry, its commands carry past errors of measurement. If these are
coloured, past commands then seem to tell of the next error, though only past errors do. What
something explains must go beyond that.
"""

from itertools import pairwise

import numpy as np

from diffbot_sim.identification.statistics.robust import ROUNDING, huber
from diffbot_sim.records import Array

# Edges of the spans in which past errors are averaged, in samples.
SPANS = (0, 1, 2, 3, 5, 8, 13, 21, 34, 55)
# An error of more standard deviations tells no more of those that follow: it may be an outlier.
LARGEST = 6.0


def fall_of_deviance(before: Array, after: Array) -> float:
    """Return how much less some whitened errors (n, 2) weigh than others; no less than nothing.

    Weighed as they are, and beyond what their own past tells of them: the lesser fall counts.
    """
    as_they_are = float(huber(before).sum() - huber(after).sum())
    return max(min(as_they_are, float(falls_beyond_past(before, after).sum())), 0.0)


def falls_beyond_past(before: Array, after: Array) -> Array:
    """Return how much less the columns of some whitened errors weigh beyond what their past tells.

    Of both (n, 2); shape (2,), negative where they weigh more.
    """
    return np.asarray(len(before) * np.log(unforeseen(before) / unforeseen(after)))


def deviance_beyond_past(errors: Array, scale: Array) -> float:
    """Return -2 log-likelihood of what past errors do not tell, less what all fits share.

    errors: over their scale (2,), shape (n, 2).
    """
    return len(errors) * float(np.log(unforeseen(errors) * scale**2).sum())


def unforeseen(errors: Array) -> Array:
    """Return the mean robust square of what past errors (n, 2) do not tell of each, shape (2,).

    No less than rounding, which all errors may be.
    """
    counting = np.clip(errors, -LARGEST, LARGEST)
    total = np.vstack([np.zeros(2), np.cumsum(counting, axis=0)])
    now = np.arange(len(errors))
    past = [
        (total[np.maximum(now - near, 0)] - total[np.maximum(now - far, 0)]) / (far - near)
        for near, far in pairwise(SPANS)
    ]
    told = np.column_stack(past)
    known, *_ = np.linalg.lstsq(told, counting, rcond=1e-8)
    return np.asarray(np.maximum(np.mean(huber(errors - told @ known), axis=0), ROUNDING))
