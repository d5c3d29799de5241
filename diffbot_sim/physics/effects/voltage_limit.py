"""A motor on a supply of limited voltage: what it can give falls in a line with speed."""

from dataclasses import dataclass
from itertools import product

from diffbot_sim.parameters import largest, parameter
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.effects.effect import Effect, Excitation
from diffbot_sim.physics.stages import FAR_BELOW, Motion, Stage, Traction, nearly_within

# Stall forces over the largest command, and no-load speeds over the largest speed, to start from.
STALL, NO_LOAD = (1.0, 1.6), (1.05, 1.6)
# How brakes may be limited: by the current, too; as the motor drives.
BRAKING = (0.0, -1.0)
# What a motor can give never falls below this share of its stall force.
LEAST = 1e-3
# So near to a corner that 0.5 % are missing there: the limit changes no faster than the speed.
BEND = 128.0
# As good as none [N].
UNLIMITED = 1e9


@compiled
def offered(force: float, speed: float, stall: float, no_load: float, braking: float) -> float:
    """Return a force [N] that is hardly more than the motor can give."""
    if abs(force) <= FAR_BELOW * LEAST * stall:
        return force
    share = abs(speed) / no_load
    left = 1.0 - share if force * speed > 0.0 else 1.0 + braking * share
    return nearly_within(force, stall * max(left, LEAST), BEND)


@compiled
def limited(
    at: Motion, traction: Traction, stall: float, no_load: float, braking: float
) -> Traction:
    """Limit the force of each wheel by its speed."""
    if stall >= UNLIMITED:
        return traction
    return Traction(
        offered(traction.right, at.speed_right, stall, no_load, braking),
        offered(traction.left, at.speed_left, stall, no_load, braking),
    )


@dataclass(frozen=True)
class VoltageLimit(Effect):
    """Force on each wheel of at most stall·(1 - |v|/no_load) while it drives, rounded there.

    While it brakes, of at most stall·(1 + braking·|v|/no_load): 1 is a motor on its supply alone,
    0 one whose current is limited, too, -1 one that brakes as it drives. Beyond no_load nothing
    drives.
    """

    name = 'voltage_limit'
    meaning = 'the largest force of each wheel falls in a line with its speed'
    source = 'torque-speed line of a DC motor (Hughes and Drury, Electric Motors and Drives, 2019)'
    stage = Stage.ACTUATOR
    kernel = limited
    guesses = ((10.0, 1.0, 1.0), (4.0, 0.5, -1.0))
    essential = ('no_load_speed',)
    excitation = 'the strongest commands, from rest until it is fast, and against its motion'

    stall_force: float = largest(UNLIMITED, unit='N', meaning='largest force of a wheel at rest')
    no_load_speed: float = largest(
        1e9, unit='m/s', scale=1.0, meaning='speed at which nothing is left of it'
    )
    braking: float = parameter(
        0.0,
        unit='-',
        low=-1.0,
        high=1.0,
        scale=1.0,
        meaning='by which share of that line it grows with speed while the wheel brakes',
    )

    @classmethod
    def starts(cls, drive: Excitation) -> tuple[tuple[float, ...], ...]:
        """Try some lines that the strongest commands of the drive cross."""
        lines = product(STALL, NO_LOAD, BRAKING)
        return tuple((a * drive.force, b * drive.speed, braking) for a, b, braking in lines)
