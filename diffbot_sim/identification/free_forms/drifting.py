"""A heading that is added up from turn rates drifts, and the pull of a slope seems to turn."""

from math import hypot, sqrt

from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.free_forms.dependence import Dependence
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.statistics.norms import white_noise
from diffbot_sim.physics.effects.slope import STANDARD_GRAVITY, Slope

CHANGING_PULL = 'pull'


def is_of_drift(left: Dependence, fit: Fit) -> bool:
    """Say whether a pull that changes is no more than a drifting heading leaves of a slope."""
    slope = next((it for it in fit.model.effects if isinstance(it, Slope)), None)
    if slope is None or left.basis.variable != CHANGING_PULL:
        return False
    pull = fit.model.robot.mass * STANDARD_GRAVITY * hypot(slope.grade_x, slope.grade_y)
    return left.basis.strength(left.amounts) < pull * max(map(_drift, fit.stretches))


def _drift(stretch: Stretch) -> float:
    """Return how far the noise of the turn rate adds up to in a stretch [rad]."""
    _, rate = white_noise(stretch.twist)
    return float(rate) * sqrt(stretch.interval * (stretch.time[-1] - stretch.time[0]))
