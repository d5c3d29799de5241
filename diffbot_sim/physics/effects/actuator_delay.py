"""Pure delay between the commanded and the acting force."""

from dataclasses import dataclass

from diffbot_sim.parameters import parameter
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.effects.effect import Effect
from diffbot_sim.physics.stages import Motion, Stage, Traction


@compiled
def as_it_comes(at: Motion, traction: Traction, delay: float) -> Traction:
    """Pass on what arrives: the delay has been taken before any kernel."""
    return traction


@dataclass(frozen=True)
class ActuatorDelay(Effect):
    """Commands act a while after they are given."""

    name = 'actuator_delay'
    meaning = 'pure delay of the force'
    source = 'transport delay of a bus, a driver or a control loop'
    stage = Stage.COMMAND
    kernel = as_it_comes
    guesses = ((0.02,), (0.06,), (0.15,))
    excitation = 'steps and reversals of the command, sharper than the delay'

    time: float = parameter(
        0.0, unit='s', low=0.0, high=5.0, scale=0.03, meaning='time by which the force comes late'
    )

    @property
    def delay(self) -> float:
        """The delay itself [s]."""
        return self.time
