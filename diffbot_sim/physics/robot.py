"""The rigid robot: eqs. (7) and (11)."""

from dataclasses import dataclass

from diffbot_sim.parameters import parameter


@dataclass(frozen=True)
class Robot:
    """Mass and measures of a robot on two driven wheels."""

    mass: float = parameter(10.0, unit='kg', low=1e-3, high=1e5, meaning='mass m')
    inertia: float = parameter(
        0.4, unit='kg·m²', low=1e-6, high=1e6, meaning='moment of inertia J about the yaw axis'
    )
    wheel_separation: float = parameter(
        0.4, unit='m', low=1e-3, high=100.0, meaning='distance 2 b between the wheels'
    )
    wheel_radius: float = parameter(
        0.08, unit='m', low=1e-3, high=10.0, meaning='radius r of both wheels'
    )

    @property
    def half_separation(self) -> float:
        """Half the wheel separation, b of the paper [m]."""
        return self.wheel_separation / 2.0
