"""Force that wanes as the battery empties."""

from dataclasses import dataclass
from math import exp

from diffbot_sim.parameters import parameter
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.effects.effect import Effect
from diffbot_sim.physics.stages import Motion, Stage, Traction

# A gain that grows stops at e to this power, so that the longest run stays finite.
MOST_GROWTH = 10.0


@compiled
def fade(at: Motion, traction: Traction, rate: float) -> Traction:
    """Scale both forces by the gain that is left at this time."""
    gain = exp(min(-rate * at.time, MOST_GROWTH))
    return Traction(traction.right * gain, traction.left * gain)


@dataclass(frozen=True)
class ActuatorFade(Effect):
    """Both forces times exp(-rate·t), with t since the start of the run."""

    name = 'actuator_fade'
    meaning = 'force gain falls (+) or grows (-) with time, as a battery empties'
    source = 'discharge of batteries: Shepherd (1965), here to first order'
    stage = Stage.ACTUATOR
    kernel = fade
    guesses = ((0.001,), (-0.001,), (0.01,), (-0.01,))
    excitation = 'the same manoeuvres early and late in a long run'

    rate: float = parameter(
        0.0, unit='1/s', low=-0.05, high=0.05, scale=0.001, meaning='rate at which the gain falls'
    )
