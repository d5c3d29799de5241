"""Before and after: free-running simulation over held-out stretches."""

from collections.abc import Sequence

import numpy as np

from diffbot_sim.identification.fitting.fit import Fit, predictions
from diffbot_sim.identification.recordings.measurement import simulated
from diffbot_sim.identification.recordings.start import start_of
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.result import Comparison, ErrorNorm, Errors
from diffbot_sim.identification.statistics.norms import noise_floor, norm
from diffbot_sim.physics.model import Model
from diffbot_sim.records import Array, Trajectory

# Longest integration step of what is told in the end [s], as `simulate` has it.
SIMULATION_STEP = 0.005
# An error [m/s, rad/s] as good as none, as of the yaw rate of what cannot turn.
NOTHING = 1e-9


def run_free(model: Model, stretch: Stretch) -> Trajectory:
    """Simulate a stretch from its first state with the recorded forces alone."""
    start = start_of(model, stretch, SIMULATION_STEP)
    return simulated(model, stretch, stretch.time, start, SIMULATION_STEP)


def free_running_error(model: Model, held_out: Sequence[Stretch]) -> Array:
    """Return the error of v [m/s] and ω [rad/s] on held-out stretches, pooled, shape (2,)."""
    misses = [stretch.twist - run_free(model, stretch).twist for stretch in held_out]
    return np.maximum(norm(np.concatenate(misses)).pair, NOTHING)


def compare_models(
    declared: Model, recalibrated: Model, final: Fit, held_out: Sequence[Stretch]
) -> tuple[Comparison, ...]:
    """Run the three models over every held-out stretch."""
    return tuple(
        Comparison(
            run=stretch.run.name,
            time=stretch.time,
            twist=stretch.twist,
            pose=stretch.pose,
            declared=run_free(declared, stretch),
            recalibrated=run_free(recalibrated, stretch),
            with_effects=run_free(final.model, stretch),
            disturbance=prediction.disturbance,
        )
        for stretch, prediction in zip(held_out, predictions(final, held_out), strict=True)
    )


def errors_of(comparisons: Sequence[Comparison], split: str) -> Errors:
    """Pool the errors of all stretches."""

    def pooled(name: str) -> ErrorNorm:
        return norm(np.concatenate([c.twist - getattr(c, name).twist for c in comparisons]))

    floor = noise_floor(
        [c.twist for c in comparisons], [c.with_effects.twist for c in comparisons]
    )
    return Errors(split, pooled('declared'), pooled('recalibrated'), pooled('with_effects'), floor)
