"""What odometry tells of the wheels: a twist of the moment, or a mean since the sample before."""

from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.vector import twist_of, way_of
from diffbot_sim.records import Array


@compiled
def measured(
    params: Array, means: Array, z: Array, before: tuple[float, float], interval: float
) -> tuple[float, float]:
    """Return the twist that is measured; before: the way at the last sample, interval [s] ago.

    means: 1 for what is a mean since then, v and then ω, and 0 for what is of the moment.
    """
    (v, omega), (way, turn) = twist_of(params, z), way_of(params, z)
    mean_v, mean_omega = (way - before[0]) / interval, (turn - before[1]) / interval
    return v + means[0] * (mean_v - v), omega + means[1] * (mean_omega - omega)
