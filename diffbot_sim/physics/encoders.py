"""What odometry tells of the wheels: a twist of the moment, or a mean since the sample before."""

from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.vector import ANGLE_LEFT, ANGLE_RIGHT, SPEED_LEFT, SPEED_RIGHT
from diffbot_sim.records import Array


@compiled
def twist_of(params: Array, z: Array) -> tuple[float, float]:
    """Return speed [m/s] and turn rate [rad/s] of the moment."""
    right, left = z[SPEED_RIGHT], z[SPEED_LEFT]
    return 0.5 * (right + left), (right - left) / (2.0 * params[2])


@compiled
def way_of(params: Array, z: Array) -> tuple[float, float]:
    """Return way [m] and turn [rad] since the wheels stood at angle 0."""
    right, left = params[3] * z[ANGLE_RIGHT], params[3] * z[ANGLE_LEFT]
    return 0.5 * (right + left), (right - left) / (2.0 * params[2])


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
