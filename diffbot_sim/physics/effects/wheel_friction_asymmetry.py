"""Wheels that do not rub alike."""

from dataclasses import dataclass

from diffbot_sim.parameters import parameter
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.effects.effect import Effect
from diffbot_sim.physics.stages import Law, Motion, Stage, scaled


@compiled
def asymmetry(at: Motion, law: Law, dry: float, viscous: float) -> Law:
    """Give the right wheel more and the left wheel less."""
    return scaled(law, 1.0 + law.side * dry, 1.0 + law.side * viscous)


@dataclass(frozen=True)
class WheelFrictionAsymmetry(Effect):
    """Right wheel's friction times 1 + a, left wheel's times 1 - a."""

    name = 'wheel_friction_asymmetry'
    meaning = "one wheel's friction differs from the other's"
    source = 'eq. (13) with coefficients of its own for each wheel'
    stage = Stage.WHEEL_FRICTION
    kernel = asymmetry
    guesses = ((0.2, 0.2), (-0.2, -0.2))
    excitation = 'straight drives forward and backward, long enough to drift sideways'

    dry: float = parameter(
        0.0, unit='-', low=-1.0, high=1.0, scale=0.1, meaning='asymmetry of dry friction'
    )
    viscous: float = parameter(
        0.0, unit='-', low=-1.0, high=1.0, scale=0.1, meaning='asymmetry of viscous friction'
    )
