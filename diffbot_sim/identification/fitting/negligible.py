"""Differences between models that do not matter: two simulators of one robot differ by as much."""

import numpy as np

from diffbot_sim.identification.fitting.fit import Fit, whitened
from diffbot_sim.identification.fitting.predictor import NO_GAIN
from diffbot_sim.identification.recordings.stretches import motion_of
from diffbot_sim.identification.statistics.norms import rms_of_each
from diffbot_sim.records import Array

# Shares of the motion, and of the scale of the errors. A simulator with soft contacts left 0.17 %
# between itself and our law of the same robot, a fifth of the noise, for which a drag was worth 57
# in the BIC; effects that a drive shows above the odometry's noise made 0.6 % and more.
NEGLIGIBLE, HIDDEN = 0.0025, 0.5


def uncorrected(fit: Fit, sigma: Array) -> Array:
    """Return the errors of a fit whose speeds nothing corrects, over a scale, shape (n, 2)."""
    return whitened(fit.stretches, fit.model, NO_GAIN, sigma)


def simulates_alike(fit: Fit, errors: Array) -> bool:
    """Say whether a fit, uncorrected, differs by next to nothing from another simulation.

    errors: of the other one over the fit's sigma, shape (n, 2).
    """
    own = uncorrected(fit, fit.sigma)
    little = np.minimum(NEGLIGIBLE * motion_of(fit.stretches) / fit.sigma, HIDDEN)
    return bool(np.all(rms_of_each(errors - own) < little))
