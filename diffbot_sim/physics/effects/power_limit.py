"""A drive that gives its full force at low speed only."""

from dataclasses import dataclass
from math import hypot

from diffbot_sim.parameters import largest
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.effects.effect import Effect, Excitation
from diffbot_sim.physics.stages import Motion, Stage, Traction, nearly_within

# Shares of the largest power at which the limit may lie.
SHARES = (0.85, 0.6, 0.35)
# As good as none [W].
UNLIMITED = 1e9
# How wide the corner is [m/s], about what a robot gains in a step: a sharper one would cost the
# integrator more than its tolerance, a wider one what is identified its truth.
CORNER = 1e-2
# The bend of a wheel that hardly moves, where 6 % of the force are missing at the limit.
LEAST_BEND = 12.0


@compiled
def bend_at(speed: float) -> float:
    """Return how sharply a limit bends a force at a speed."""
    return hypot(LEAST_BEND, speed / CORNER)


@compiled
def weakened(force: float, speed: float, driving: float, braking: float) -> float:
    """Return a force [N] that does, or takes, hardly more work than these limits [W]."""
    if speed == 0.0:
        return force
    power = driving if force * speed > 0.0 else braking
    return nearly_within(force, power / abs(speed), bend_at(speed))


@compiled
def limited(at: Motion, traction: Traction, driving: float, braking: float) -> Traction:
    """Limit the power of each wheel."""
    if driving >= UNLIMITED and braking >= UNLIMITED:
        return traction
    return Traction(
        weakened(traction.right, at.speed_right, driving, braking),
        weakened(traction.left, at.speed_left, driving, braking),
    )


@dataclass(frozen=True)
class PowerLimit(Effect):
    """Force on each wheel of at most P/|v| while it drives, rounded there.

    While it brakes, of at most P_b/|v|: some drives limit the power that they give alone. Each
    wheel has its own, and it is mechanical: what heats the motors does not count.
    """

    name = 'power_limit'
    meaning = 'power of each wheel is limited, so its force falls as it gets faster'
    source = 'constant-power range of electric traction drives (Larminie and Lowry, 2012)'
    stage = Stage.ACTUATOR
    kernel = limited
    guesses = ((10.0, UNLIMITED), (3.0, 3.0))
    excitation = 'the strongest commands, held until it is fast, and against its motion'

    power: float = largest(UNLIMITED, unit='W', meaning='largest power P of a wheel that drives')
    braking_power: float = largest(
        UNLIMITED, unit='W', meaning='largest power P_b of a wheel that brakes'
    )

    @classmethod
    def starts(cls, drive: Excitation) -> tuple[tuple[float, ...], ...]:
        """Try shares of the largest power asked for, with brakes that are limited alike or not."""
        powers = [share * drive.power for share in SHARES]
        return tuple((power, braking) for power in powers for braking in (power, UNLIMITED))
