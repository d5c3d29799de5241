"""Commands too small to have an effect."""

from dataclasses import dataclass

from diffbot_sim.parameters import parameter
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.effects.effect import Effect
from diffbot_sim.physics.stages import Motion, Stage, Traction, within


@compiled
def deadband(at: Motion, traction: Traction, band: float) -> Traction:
    """Let each wheel feel only what exceeds the band."""
    return Traction(
        traction.right - within(traction.right, band), traction.left - within(traction.left, band)
    )


@dataclass(frozen=True)
class ActuatorDeadband(Effect):
    """Command u acts as u - band above the band, as u + band below -band, between them not."""

    name = 'actuator_deadband'
    meaning = 'small commands have no effect, larger ones lose the band'
    source = 'dead zone: Tao, Kokotović (1996), control with actuator nonlinearities'
    stage = Stage.COMMAND
    kernel = deadband
    guesses = ((0.3,), (1.5,))
    excitation = 'small and large commands of either sign, also while rolling fast'

    band: float = parameter(
        0.0, unit='N', low=0.0, high=1e4, scale=0.3, meaning='largest command without effect'
    )
