"""Wheel friction that changes in the course of a run."""

from dataclasses import dataclass
from math import exp

from diffbot_sim.parameters import parameter
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.effects.effect import Effect
from diffbot_sim.physics.stages import Law, Motion, Stage, scaled


@compiled
def drift(at: Motion, law: Law, dry: float, viscous: float, time_constant: float) -> Law:
    """Approach the changed friction; before the start nothing has changed."""
    if dry == viscous == 0.0:
        return law
    progress = 1.0 - exp(-max(at.time, 0.0) / time_constant)
    return scaled(law, 1.0 + dry * progress, 1.0 + viscous * progress)


@dataclass(frozen=True)
class FrictionDrift(Effect):
    """Friction times 1 + d·(1 - exp(-t/τ)), with t since the start of the run.

    Warm-up lowers friction (d < 0), wear raises it (d > 0). While d = 0, τ is without meaning.
    """

    name = 'friction_drift'
    meaning = 'friction of both wheels changes with time: warm-up (-), wear (+)'
    source = 'Bittencourt, Gunnarsson (2012), joint friction as grease warms up'
    stage = Stage.WHEEL_FRICTION
    kernel = drift
    is_of_time = True
    guesses = tuple((d, d, tau) for tau in (10.0, 60.0, 300.0) for d in (-0.3, 0.3))
    shape = ('time_constant',)
    excitation = 'the same speeds early and late in a run of several time constants'

    dry: float = parameter(
        0.0, unit='-', low=-0.95, high=20.0, scale=0.1, meaning='final change d of dry friction'
    )
    viscous: float = parameter(
        0.0,
        unit='-',
        low=-0.95,
        high=20.0,
        scale=0.1,
        meaning='final change d of viscous friction',
    )
    time_constant: float = parameter(
        60.0, unit='s', low=1.0, high=1e4, scale=30.0, meaning='time constant τ of the change'
    )
