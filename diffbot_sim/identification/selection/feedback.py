"""Controllers that hear more than was recorded, and so make a robot seem late.

A controller that hears speeds between the samples, or without their noise, answers what a floor
has just done to the robot. Its forces tell that before the odometry does, and a robot that hardly
heeds them at first, a late one, seems to be predicted better. (The inputs of a closed loop must
not tell of disturbances to come: Ljung, *System Identification*, 13.4.) But a force that jumps for
another reason, as for another speed that is asked for, is heeded in full.
"""

import numpy as np

from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.recordings.lateness import LATE_EFFECTS
from diffbot_sim.identification.selection.evidence import beside_others

# The share of what is known that comes from forces that hardly change. By how many deviations a
# robot must be later there than elsewhere, and how many elsewhere are beyond doubt all the same.
HARDLY, FADING, SURE = 0.25, 2.5, 8.0


def is_of_feedback(fit: Fit, name: str) -> bool:
    """Say whether that a robot is late may be due to a controller that hears more.

    So it may where it is later while forces hardly change than where they jump, and not late
    beyond doubt there.
    """
    if name not in LATE_EFFECTS:
        return False
    errors, columns = beside_others(fit, fit.space.places(name))
    slope = columns[:, 0]
    order = np.argsort(np.abs(slope))
    known = np.cumsum(slope[order] ** 2)
    parts = np.split(order, [int(np.searchsorted(known, HARDLY * known[-1]))])
    calm, jumping = (-slope[p] @ errors[p] / (slope[p] @ slope[p]) for p in parts)
    calm_sd, jumping_sd = (1.0 / np.linalg.norm(slope[p]) for p in parts)
    fades = calm - jumping > FADING * np.hypot(calm_sd, jumping_sd)
    return bool(fades and jumping < SURE * jumping_sd)
