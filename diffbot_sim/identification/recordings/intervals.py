"""Times between stamps."""

import numpy as np

from diffbot_sim.records import Array


def median_interval(time: Array) -> float:
    """Return the median time between stamps [s]; a second where there are not two."""
    return float(np.median(np.diff(time))) if len(time) > 1 else 1.0


def mean_interval(time: Array) -> float:
    """Return the mean time between stamps [s]: unlike the median it bears stamps in twos."""
    return float(time[-1] - time[0]) / (len(time) - 1) if len(time) > 1 else 1.0
