"""Force that acts without a command."""

from dataclasses import dataclass

from diffbot_sim.parameters import parameter
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.effects.effect import Effect
from diffbot_sim.physics.stages import Motion, Stage, Traction


@compiled
def bias(at: Motion, traction: Traction, right: float, left: float) -> Traction:
    """Add a force of its own to each wheel."""
    return Traction(traction.right + right, traction.left + left)


@dataclass(frozen=True)
class ForceBias(Effect):
    """Acting force = command + bias, on each wheel its own."""

    name = 'force_bias'
    meaning = 'a constant force on one wheel or both'
    source = 'Janot, Gautier, Brunot (2019), EMPS: offset of the current amplifier'
    stage = Stage.DRIVETRAIN
    kernel = bias
    guesses = ((0.3, 0.3), (-0.3, -0.3), (0.3, -0.3), (-0.3, 0.3))
    excitation = 'the same speeds driven forward and backward, and turns either way'

    right: float = parameter(
        0.0, unit='N', low=-1e4, high=1e4, scale=0.3, meaning='force on the right wheel'
    )
    left: float = parameter(
        0.0, unit='N', low=-1e4, high=1e4, scale=0.3, meaning='force on the left wheel'
    )
