"""A motor on a supply of limited voltage: what it can give falls in a line with speed."""

from dataclasses import dataclass

from diffbot_sim.parameters import parameter
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.effects.effect import Effect, Excitation
from diffbot_sim.physics.stages import FAR_BELOW, Motion, Stage, Traction, nearly_within

# Stall forces over the largest command, and no-load speeds over the largest speed, to start from.
STALL, NO_LOAD = (1.0, 1.6), (1.05, 1.6)
# What a motor can give never falls below this share of its stall force.
LEAST = 1e-3
# So near to a corner that 0.5 % are missing there: the limit changes no faster than the speed.
BEND = 128.0


@compiled
def offered(force: float, speed: float, stall: float, no_load: float) -> float:
    """Return a force [N] that is hardly more than the motor can give while it drives."""
    if abs(force) <= FAR_BELOW * LEAST * stall:
        return force
    driving = abs(speed) if force * speed > 0.0 else 0.0
    return nearly_within(force, stall * max(1.0 - driving / no_load, LEAST), BEND)


@compiled
def limited(at: Motion, traction: Traction, stall: float, no_load: float) -> Traction:
    """Limit the force of each wheel by its speed."""
    return Traction(
        offered(traction.right, at.speed_right, stall, no_load),
        offered(traction.left, at.speed_left, stall, no_load),
    )


@dataclass(frozen=True)
class VoltageLimit(Effect):
    """Force on each wheel of at most stall·(1 - |v|/no_load) while it drives, rounded there."""

    name = 'voltage_limit'
    meaning = 'the largest force of each wheel falls in a line with its speed'
    source = 'torque-speed line of a DC motor (Hughes and Drury, Electric Motors and Drives, 2019)'
    stage = Stage.ACTUATOR
    kernel = limited
    guesses = ((10.0, 1.0), (4.0, 0.5))
    essential = ('no_load_speed',)
    excitation = 'the strongest commands, from rest until the robot is fast'

    stall_force: float = parameter(
        1e9,
        unit='N',
        low=1e-3,
        high=1e9,
        scale=10.0,
        reciprocal=True,
        meaning='largest force of a wheel at rest',
    )
    no_load_speed: float = parameter(
        1e9,
        unit='m/s',
        low=1e-3,
        high=1e9,
        scale=1.0,
        reciprocal=True,
        meaning='speed at which nothing is left of it',
    )

    @classmethod
    def starts(cls, drive: Excitation) -> tuple[tuple[float, ...], ...]:
        """Try some lines that the strongest commands of the drive cross."""
        return tuple((a * drive.force, b * drive.speed) for a in STALL for b in NO_LOAD)
