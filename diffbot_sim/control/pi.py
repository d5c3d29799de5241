"""PI law of one wheel: Fig. 13, with an output limit, a sum within it, and back-calculation."""

from dataclasses import dataclass

from diffbot_sim.parameters import parameter
from diffbot_sim.physics.kinematics import wheel_speeds
from diffbot_sim.physics.robot import Robot


@dataclass(frozen=True)
class Gains:
    """What tunes the law; the same for both wheels."""

    kp: float = parameter(
        4.0, unit='N·s/rad', low=0.0, high=1e6, meaning='proportional gain on wheel speed'
    )
    ki: float = parameter(
        10.0, unit='N/rad', low=0.0, high=1e6, meaning='integral gain on wheel speed'
    )
    force_limit: float = parameter(
        20.0, unit='N', low=0.0, high=1e6, meaning='largest force on one wheel'
    )
    tracking_time: float = parameter(
        0.2, unit='s', low=1e-3, high=1e3, meaning='time in which a limited output unwinds the sum'
    )


def control(
    gains: Gains,
    integral: float,
    reference: float,
    measured: float,
    dt: float,
    in_advance: float = 0.0,
) -> tuple[float, float]:
    """Return the force [N] and the integral part [N] to hand in next time.

    reference and measured are wheel speeds [rad/s]; dt [s] has passed since the last call;
    in_advance: a force [N] that is given whatever the error.
    """
    error, limit = reference - measured, gains.force_limit
    integral += gains.ki * error * dt
    wanted = gains.kp * error + integral + in_advance
    force = _within(wanted, limit)
    # More than the whole excess would overshoot, so a long dt unwinds it at once.
    integral += (force - wanted) * min(dt / gains.tracking_time, 1.0)
    # A reference far out of reach, if only for a moment, must not be made up for afterwards.
    return force, _within(integral, limit)


def _within(force: float, limit: float) -> float:
    return min(max(force, -limit), limit)


def wheel_rates(v: float, omega: float, robot: Robot) -> tuple[float, float]:
    """Return the angular speeds [rad/s] of the right and left wheel for v [m/s], ω [rad/s]."""
    right, left = wheel_speeds(v, omega, robot.half_separation)
    return right / robot.wheel_radius, left / robot.wheel_radius
