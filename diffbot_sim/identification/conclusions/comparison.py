"""Before and after: free-running simulation over held-out stretches."""

from collections.abc import Sequence

import numpy as np

from diffbot_sim.identification.fitting.fit import Fit, predictions
from diffbot_sim.identification.recordings.free_running import run_free
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.result import Comparison, ErrorNorm, Errors
from diffbot_sim.identification.statistics.norms import noise_floor, norm
from diffbot_sim.physics.model import Model


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
