"""First-order lag between the commanded and the acting force."""

from dataclasses import dataclass
from math import exp

from diffbot_sim.parameters import parameter
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.effects.effect import Effect
from diffbot_sim.physics.stages import Motion, Stage, Traction


@compiled
def lag(
    at: Motion, traction: Traction, held_right: float, held_left: float, time_constant: float
) -> Traction:
    """Relax towards the command; exact for a command that holds still, so never stiff."""
    if time_constant <= 0.0:
        return traction
    rest = exp(-at.elapsed / time_constant)
    return Traction(
        traction.right + (held_right - traction.right) * rest,
        traction.left + (held_left - traction.left) * rest,
    )


@dataclass(frozen=True)
class ActuatorLag(Effect):
    """Acting force f with τ df/dt = command - f."""

    name = 'actuator_lag'
    meaning = 'first-order lag between commanded and acting force'
    source = 'electrical time constant of a motor or a filter in its driver'
    stage = Stage.ACTUATOR
    kernel = lag
    states = 2
    update = lag
    guesses = ((0.02,), (0.1,), (0.4,))
    excitation = 'steps and reversals of the command, faster than the lag'

    time_constant: float = parameter(
        0.0, unit='s', low=0.0, high=5.0, scale=0.03, meaning='time constant τ of the lag'
    )

    @classmethod
    def initial_state(cls, command: Traction) -> tuple[float, ...]:
        """Return the command itself: it has had time to act."""
        return tuple(command)
