"""Intervals: block-robust covariance of the fit, carried over to the parameters' own units."""

import numpy as np
from scipy import stats

from diffbot_sim.identification.evidence import BLOCKS, covariance
from diffbot_sim.identification.fitting import Fit
from diffbot_sim.identification.result import Estimate

LEVEL = 0.95
STEP = 1e-4


def estimates(fit: Fit) -> dict[str, Estimate]:
    """Return every fitted parameter by its name, with its 95 % interval."""
    values = fit.space.values(fit.u)
    names = list(values)
    size = len(fit.u)
    derivative = np.empty((len(names), size))
    for index in range(size):
        moved = fit.u.copy()
        moved[index] += STEP
        shifted = fit.space.values(moved)
        derivative[:, index] = [(shifted[name] - values[name]) / STEP for name in names]
    spread = derivative @ covariance(fit)[:size, :size] @ derivative.T
    reach = stats.t.ppf(0.5 + LEVEL / 2, BLOCKS - 1) * np.sqrt(np.maximum(np.diag(spread), 0.0))
    units = {coordinate.name: coordinate.unit for coordinate in fit.space.coordinates}
    return {
        name: Estimate(
            values[name], values[name] - float(half), values[name] + float(half), units[name]
        )
        for name, half in zip(names, reach, strict=True)
    }
