"""Wheels that answer the same command with different force."""

from dataclasses import dataclass

from diffbot_sim.parameters import parameter
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.effects.effect import Effect
from diffbot_sim.physics.stages import Motion, Stage, Traction


@compiled
def unequal(at: Motion, traction: Traction, imbalance: float) -> Traction:
    """Give the right wheel more and the left wheel less."""
    return Traction(traction.right * (1.0 + imbalance), traction.left * (1.0 - imbalance))


@dataclass(frozen=True)
class ActuatorGain(Effect):
    """Right wheel's force times 1 + δ, left wheel's times 1 - δ.

    A factor common to both has no parameter: mass, inertia and friction divided by it give the
    same motion, so no drive can tell the two apart.
    """

    name = 'actuator_gain'
    meaning = "one wheel's force acts with a larger gain than the other's"
    source = 'motor law, torque = k·i, with a constant k that scatters from motor to motor'
    stage = Stage.DRIVETRAIN
    kernel = unequal
    guesses = ((0.05,), (-0.05,))
    excitation = 'straight drives with strong pushes and brakes, forward and backward'

    imbalance: float = parameter(
        0.0, unit='-', low=-0.9, high=0.9, scale=0.03, meaning='imbalance δ of the gains'
    )
