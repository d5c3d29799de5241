"""Differences between models that do not matter: two simulators of one robot differ by as much."""

from collections.abc import Sequence

import numpy as np

from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.fitting.predictor import NO_GAIN, predict
from diffbot_sim.identification.recordings.stretches import Stretch, motion_of
from diffbot_sim.identification.statistics.norms import rms_of_each
from diffbot_sim.physics.model import Model
from diffbot_sim.records import Array

# Shares of the motion, and of the scale of the errors. A simulator with soft contacts left 0.17 %
# between itself and our law of the same robot, a fifth of the noise, for which a drag was worth 57
# in the BIC; effects that a drive shows above the odometry's noise made 0.6 % and more.
NEGLIGIBLE, HIDDEN = 0.0025, 0.5


def simulated(model: Model, stretches: Sequence[Stretch]) -> Array:
    """Return v and ω where they count, as the recorded forces and pushes alone drive a model."""
    runs = [predict(model, stretch, NO_GAIN).twist[stretch.used > 0] for stretch in stretches]
    return np.concatenate(runs)


def is_negligible(difference: Array, fit: Fit) -> bool:
    """Say whether simulations (n, 2) differ by nothing beside the motion and errors of a fit."""
    little = np.minimum(NEGLIGIBLE * motion_of(fit.stretches), HIDDEN * fit.sigma)
    return bool(np.all(rms_of_each(difference) < little))
