"""Times between stamps."""

import numpy as np

from diffbot_sim.records import Array


def median_interval(time: Array) -> float:
    """Return the median time between stamps [s]; a second where there are not two."""
    return float(np.median(np.diff(time))) if len(time) > 1 else 1.0


def usual_interval(time: Array) -> float:
    """Return the usual time between stamps [s], which bears pauses as well as stamps in twos."""
    if len(time) < 3:
        return median_interval(time)
    return 0.5 * float(np.median(time[2:] - time[:-2]))
