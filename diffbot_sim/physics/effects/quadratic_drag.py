"""Drag that grows with the square of speed."""

from dataclasses import dataclass

from diffbot_sim.parameters import parameter
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.effects.effect import Effect
from diffbot_sim.physics.stages import Load, Motion, Stage, pushed


@compiled
def drag(at: Motion, load: Load, coefficient: float) -> Load:
    """Push against the motion with c v²."""
    return pushed(load, -coefficient * at.v * abs(at.v), 0.0)


@dataclass(frozen=True)
class QuadraticDrag(Effect):
    """Body force -c·v·|v|."""

    name = 'quadratic_drag'
    meaning = 'body force against the motion that grows with the square of speed'
    source = 'drag equation (Rayleigh), F = c v²'
    stage = Stage.BODY_LOAD
    kernel = drag
    dissipative = True
    guesses = ((0.5,), (5.0,))
    excitation = 'straight drives at several speeds, up to the fastest'

    coefficient: float = parameter(
        0.0, unit='N·s²/m²', low=0.0, high=1e4, scale=2.0, meaning='drag coefficient c'
    )
