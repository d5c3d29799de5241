"""Free-running simulation of stretches: the recorded forces alone, from the first state on."""

from collections.abc import Sequence

import numpy as np

from diffbot_sim.identification.recordings.measurement import simulated
from diffbot_sim.identification.recordings.start import start_of
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.statistics.norms import rms_of_each
from diffbot_sim.physics.model import Model
from diffbot_sim.physics.simulation import LONGEST_STEP
from diffbot_sim.records import Array, Trajectory

# An error [m/s, rad/s] as good as none, as of the yaw rate of what cannot turn.
NOTHING = 1e-9


def run_free(model: Model, stretch: Stretch) -> Trajectory:
    """Simulate a stretch from its first state with the recorded forces alone."""
    start = start_of(model, stretch, LONGEST_STEP)
    return simulated(model, stretch, stretch.time, start, LONGEST_STEP)


def free_running_error(model: Model, held_out: Sequence[Stretch]) -> Array:
    """Return the error of v [m/s] and ω [rad/s] on held-out stretches, pooled, shape (2,)."""
    misses = [stretch.twist - run_free(model, stretch).twist for stretch in held_out]
    return np.maximum(rms_of_each(np.concatenate(misses)), NOTHING)
