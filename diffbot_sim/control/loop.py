"""The inner loop of both wheels: limited acceleration, feed-forward, and the PI law of Fig. 13."""

from dataclasses import dataclass, field
from typing import NamedTuple

from diffbot_sim.control.feed_forward import wheel_forces
from diffbot_sim.control.pi import Gains, control, wheel_rates
from diffbot_sim.parameters import parameter
from diffbot_sim.physics import Friction, Robot
from diffbot_sim.physics.kinematics import body_twist
from diffbot_sim.records import Pair


@dataclass(frozen=True)
class Acceleration:
    """How fast references may change, whatever is asked; 0 = at once."""

    linear: float = parameter(
        0.0, unit='m/s²', low=0.0, high=1e3, meaning='largest change of v; 0 = at once'
    )
    angular: float = parameter(
        0.0, unit='rad/s²', low=0.0, high=1e4, meaning='largest change of ω; 0 = at once'
    )


@dataclass(frozen=True)
class LoopSettings:
    """What the loop needs to know; friction, mass and inertia serve the feed-forward only."""

    feed_forward: float = parameter(
        0.0, low=0.0, high=1.0, meaning="share of the model's force that is given in advance"
    )
    acceleration: Acceleration = field(default=Acceleration())
    pi: Gains = field(default=Gains())
    robot: Robot = field(default=Robot())
    friction: Friction = field(default=Friction())


class Output(NamedTuple):
    """What the loop gives, right and left: wanted wheel speeds [rad/s] and forces [N]."""

    reference: Pair
    force: Pair


class InnerLoop:
    """Keeps what the loop must remember from one step to the next."""

    def __init__(self) -> None:
        self.reset()

    def reset(self) -> None:
        """Begin anew: no sums, and references that start from the measured speed."""
        self._integrals: Pair = (0.0, 0.0)
        self._twist: Pair | None = None

    def step(self, settings: LoopSettings, wanted: Pair, measured: Pair, dt: float) -> Output:
        """Return references and forces for wanted and measured wheel speeds [rad/s].

        dt [s] has passed since the last step.
        """
        robot, limits = settings.robot, settings.acceleration
        asked, now = _twist_of(wanted, robot), _twist_of(measured, robot)
        last = self._twist or now
        v = _nearer(last[0], asked[0], limits.linear, dt)
        omega = _nearer(last[1], asked[1], limits.angular, dt)
        ahead = self._in_advance(settings, last, (v, omega), dt)
        self._twist = v, omega
        reference = wheel_rates(v, omega, robot)
        (right, sum_right), (left, sum_left) = (
            control(settings.pi, self._integrals[i], reference[i], measured[i], dt, ahead[i])
            for i in range(2)
        )
        self._integrals = sum_right, sum_left
        return Output(reference, (right, left))

    def _in_advance(self, settings: LoopSettings, last: Pair, twist: Pair, dt: float) -> Pair:
        """Return the share of the model's forces [N] that is asked for.

        A step without limit has no acceleration to speak of: the model gives its friction only.
        """
        if not settings.feed_forward:
            return 0.0, 0.0
        limits = (settings.acceleration.linear, settings.acceleration.angular)
        v, omega = (
            (new - old) / dt if limit and dt > 0.0 else 0.0
            for old, new, limit in zip(last, twist, limits, strict=True)
        )
        right, left = wheel_forces(settings.robot, settings.friction, twist, (v, omega))
        return settings.feed_forward * right, settings.feed_forward * left


def _twist_of(rates: Pair, robot: Robot) -> Pair:
    radius = robot.wheel_radius
    return body_twist(rates[0] * radius, rates[1] * radius, robot.half_separation)


def _nearer(last: float, wanted: float, limit: float, dt: float) -> float:
    """Return a value on the way from the last to the wanted one, as far as the limit allows."""
    if not limit:
        return wanted
    return last + min(max(wanted - last, -limit * dt), limit * dt)
