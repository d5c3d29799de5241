"""A motor that cannot give what is asked."""

from dataclasses import dataclass

from diffbot_sim.parameters import largest
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.effects.effect import Effect, Excitation
from diffbot_sim.physics.stages import Motion, Stage, Traction, within

# Shares of the largest command at which the limit may lie.
SHARES = (0.9, 0.75, 0.6, 0.4)


@compiled
def clipped(at: Motion, traction: Traction, limit: float) -> Traction:
    """Give at most the limit, either way."""
    return Traction(within(traction.right, limit), within(traction.left, limit))


@dataclass(frozen=True)
class ActuatorSaturation(Effect):
    """Acting force within ±limit on each wheel."""

    name = 'actuator_saturation'
    meaning = 'force is clipped at a limit that the command exceeds'
    source = 'current limit of a motor driver'
    stage = Stage.COMMAND
    kernel = clipped
    guesses = ((8.0,), (4.0,))
    excitation = 'commands from weak to the strongest that the driver takes'

    limit: float = largest(1e6, unit='N', meaning='largest force on a wheel')

    @classmethod
    def starts(cls, drive: Excitation) -> tuple[tuple[float, ...], ...]:
        """Try shares of the largest command."""
        return tuple((share * drive.force,) for share in SHARES)
