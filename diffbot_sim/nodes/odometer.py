"""What the simulated odometry measures."""

import numpy as np

from diffbot_sim.nodes.settings import OdometryNoise
from diffbot_sim.records import Array

# Places of v and ω on the diagonal of a 6x6 covariance.
V, OMEGA = 0, 5


class Odometer:
    """Adds seeded noise to the true twist and says how large it is."""

    def __init__(self, noise: OdometryNoise, floor: float) -> None:
        self._noise = noise
        self._random = np.random.default_rng(noise.seed)
        self.pose_covariance = _diagonal(np.full(6, floor))
        variance = np.full(6, floor)
        variance[V] = max(noise.linear**2, floor)
        variance[OMEGA] = max(noise.angular**2, floor)
        self.twist_covariance = _diagonal(variance)

    def measure(self, twist: tuple[float, float]) -> tuple[float, float]:
        """Return v [m/s] and ω [rad/s] with noise."""
        draw_v, draw_omega = self._random.standard_normal(2).tolist()
        return (
            twist[0] + self._noise.linear * draw_v,
            twist[1] + self._noise.angular * draw_omega,
        )


def _diagonal(variance: Array) -> Array:
    flat: Array = np.diag(variance).ravel()
    return flat
