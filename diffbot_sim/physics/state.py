"""Where a robot is and how it moves at one moment."""

from dataclasses import dataclass


@dataclass(frozen=True)
class State:
    """Pose [m, m, rad] and twist [m/s, rad/s] of the axle midpoint.

    travelled [m] and turned [rad] since the wheels stood at angle 0.
    """

    x: float = 0.0
    y: float = 0.0
    heading: float = 0.0
    v: float = 0.0
    omega: float = 0.0
    travelled: float = 0.0
    turned: float = 0.0
