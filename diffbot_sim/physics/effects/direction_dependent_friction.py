"""Friction that differs between forward and backward rolling."""

from dataclasses import dataclass

from diffbot_sim.parameters import parameter
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.effects.effect import Effect
from diffbot_sim.physics.stages import Law, Motion, Stage, scaled


@compiled
def direction_dependence(at: Motion, law: Law, dry: float, viscous: float) -> Law:
    """Give forward rolling more and backward rolling less."""
    return scaled(law, 1.0 + law.direction * dry, 1.0 + law.direction * viscous)


@dataclass(frozen=True)
class DirectionDependentFriction(Effect):
    """Friction times 1 + d while rolling forward, times 1 - d while rolling backward."""

    name = 'direction_dependent_friction'
    meaning = 'friction differs between forward and backward rolling'
    source = 'Janot, Gautier, Brunot (2019), EMPS: separate coefficients for each direction'
    stage = Stage.WHEEL_FRICTION
    kernel = direction_dependence
    guesses = ((0.2, 0.2), (-0.2, -0.2))
    excitation = 'the same speeds driven forward and backward, at more than one heading'

    dry: float = parameter(
        0.0, unit='-', low=-1.0, high=1.0, scale=0.1, meaning='direction dependence, dry part'
    )
    viscous: float = parameter(
        0.0, unit='-', low=-1.0, high=1.0, scale=0.1, meaning='direction dependence, viscous part'
    )
