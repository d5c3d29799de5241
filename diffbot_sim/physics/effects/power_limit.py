"""A drive that gives its full force at low speed only."""

from dataclasses import dataclass
from math import hypot

from diffbot_sim.parameters import parameter
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.effects.effect import Effect, Excitation
from diffbot_sim.physics.stages import Motion, Stage, Traction, nearly_within

# Shares of the largest power at which the limit may lie.
SHARES = (0.85, 0.6, 0.35)
# How wide the corner is [m/s], about what a robot gains in a step: a sharper one would cost the
# integrator more than its tolerance, a wider one what is identified its truth.
CORNER = 8e-3
# The bend of a wheel that hardly moves, where 4 % of the force are missing at the limit.
LEAST_BEND = 16.0


@compiled
def weakened(force: float, speed: float, limit: float) -> float:
    """Return a force [N] that does hardly more work than the limit [W]; braking is not limited."""
    if force * speed <= 0.0:
        return force
    return nearly_within(force, limit / abs(speed), hypot(LEAST_BEND, speed / CORNER))


@compiled
def limited(at: Motion, traction: Traction, limit: float) -> Traction:
    """Limit the power of each wheel."""
    return Traction(
        weakened(traction.right, at.speed_right, limit),
        weakened(traction.left, at.speed_left, limit),
    )


@dataclass(frozen=True)
class PowerLimit(Effect):
    """Force on each wheel of at most P/|v| while it drives, rounded there."""

    name = 'power_limit'
    meaning = 'power of each wheel is limited, so its force falls as it gets faster'
    source = 'constant-power range of electric traction drives (Larminie and Lowry, 2012)'
    stage = Stage.ACTUATOR
    kernel = limited
    guesses = ((10.0,), (3.0,))
    excitation = 'the strongest commands, held until the robot is fast'

    power: float = parameter(
        1e9,
        unit='W',
        low=1e-3,
        high=1e9,
        scale=10.0,
        reciprocal=True,
        meaning='largest power P of a wheel',
    )

    @classmethod
    def starts(cls, drive: Excitation) -> tuple[tuple[float, ...], ...]:
        """Try shares of the largest power asked for."""
        return tuple((share * drive.power,) for share in SHARES)
