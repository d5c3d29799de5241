"""Force that rises and falls with the angle of each wheel."""

from dataclasses import dataclass
from math import cos, sin

from diffbot_sim.parameters import parameter
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.effects.effect import Effect, Excitation
from diffbot_sim.physics.stages import Motion, Stage, Traction


@compiled
def ripple(
    at: Motion,
    traction: Traction,
    order: float,
    right_cos: float,
    right_sin: float,
    left_cos: float,
    left_sin: float,
) -> Traction:
    """Add to each wheel the force that belongs to its angle; it holds still while stuck."""
    if right_cos == right_sin == left_cos == left_sin == 0.0:
        return traction
    right, left = order * at.angle_right, order * at.angle_left
    return Traction(
        traction.right + right_cos * cos(right) + right_sin * sin(right),
        traction.left + left_cos * cos(left) + left_sin * sin(left),
    )


def amplitude(meaning: str) -> float:
    """Declare one of the four amplitudes [N]."""
    value: float = parameter(0.0, unit='N', low=-1e4, high=1e4, scale=0.2, meaning=meaning)
    return value


@dataclass(frozen=True)
class WheelRipple(Effect):
    """Force c·cos(nθ) + s·sin(nθ) that drives each wheel, with its own angle θ.

    θ is 0 at the start of a run; of several that are identified together, of the first one. Both
    wheels have one n.

    It derives from a potential, so a full period does no work. While c = s = 0, n is without
    meaning.
    """

    name = 'wheel_ripple'
    meaning = 'force ripple periodic in the wheel angle: cogging, worn gear teeth'
    source = 'cogging torque of permanent-magnet motors (Hanselman), errors of gear meshing'
    stage = Stage.DRIVETRAIN
    kernel = ripple
    guesses = ((1.0, 0.3, 0.0, 0.0, 0.3), (12.0, 0.0, 0.3, 0.3, 0.0))
    shape = ('order',)
    excitation = 'slow, steady rolling over many turns of each wheel'

    order: float = parameter(
        1.0, unit='-', low=0.05, high=200.0, scale=1.0, meaning='cycles n per turn of the wheel'
    )
    right_cos: float = amplitude('amplitude c of the right wheel')
    right_sin: float = amplitude('amplitude s of the right wheel')
    left_cos: float = amplitude('amplitude c of the left wheel')
    left_sin: float = amplitude('amplitude s of the left wheel')

    @classmethod
    def starts(cls, drive: Excitation) -> tuple[tuple[float, ...], ...]:
        """Try the orders at which the residual repeats; their amplitudes follow."""
        return tuple((order, 0.1, 0.0, 0.1, 0.0) for order in drive.orders) or cls.guesses[:1]
