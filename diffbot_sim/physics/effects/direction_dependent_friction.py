"""Friction that differs between forward and backward rolling."""

from dataclasses import dataclass

from diffbot_sim.parameters import parameter
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.effects.effect import Effect
from diffbot_sim.physics.stages import Law, Motion, Stage


@compiled
def direction_dependence(
    at: Motion, law: Law, dry: float, viscous: float, breakaway: float
) -> Law:
    """Give forward rolling more and backward rolling less."""
    more, more_viscous = 1.0 + law.direction * dry, 1.0 + law.direction * viscous
    return Law(
        law.side,
        law.direction,
        law.traction,
        law.burden,
        law.static * max(more + law.direction * breakaway, 0.0),
        law.coulomb * more,
        law.excess * more,
        law.viscous * more_viscous,
        law.stribeck,
    )


@dataclass(frozen=True)
class DirectionDependentFriction(Effect):
    """Friction times 1 + d while rolling forward, times 1 - d while rolling backward.

    What holds a wheel at rest may differ otherwise: what rubs more one way need not stick more.
    """

    name = 'direction_dependent_friction'
    meaning = 'friction differs between forward and backward rolling'
    source = 'Janot, Gautier, Brunot (2019), EMPS: separate coefficients for each direction'
    stage = Stage.WHEEL_FRICTION
    kernel = direction_dependence
    guesses = ((0.2, 0.2, 0.0), (-0.2, -0.2, 0.0))
    excitation = 'the same speeds driven forward and backward, at more than one heading'

    dry: float = parameter(
        0.0, unit='-', low=-1.0, high=1.0, scale=0.1, meaning='direction dependence, dry part'
    )
    viscous: float = parameter(
        0.0, unit='-', low=-1.0, high=1.0, scale=0.1, meaning='direction dependence, viscous part'
    )
    breakaway: float = parameter(
        0.0,
        unit='-',
        low=-1.0,
        high=1.0,
        scale=0.1,
        meaning='the same of breaking away, beyond that',
    )
