"""Centre of gravity off the wheel axle."""

from dataclasses import dataclass

from diffbot_sim.parameters import parameter
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.effects.effect import Effect
from diffbot_sim.physics.stages import Balance, Motion, Stage


@compiled
def offset_balance(at: Motion, balance: Balance, offset: float) -> Balance:
    """Couple driving and turning through the offset; the extra terms do no work."""
    return Balance(
        balance.mass,
        balance.inertia + balance.mass * offset * offset,
        balance.force + balance.mass * offset * at.omega * at.omega,
        balance.torque + balance.mass * offset * (balance.gravity_y - at.omega * at.v),
        balance.gravity_x,
        balance.gravity_y,
    )


@dataclass(frozen=True)
class ComOffset(Effect):
    """m (dv/dt - d ω²) = F and (J + m d²) dω/dt + m d ω v = τ, with J about the centre.

    A slope pulls at the centre, too. The weight on the wheels, and with it their friction, stays.
    """

    name = 'com_offset'
    meaning = 'centre of gravity ahead of (+) or behind (-) the wheel axle'
    source = 'Dhaouadi, Abu Hatab (2013), dynamic modelling of differential-drive robots'
    stage = Stage.INERTIA
    kernel = offset_balance
    guesses = ((0.03,), (-0.03,), (0.15,), (-0.15,))
    excitation = 'fast arcs and turns on the spot, forward and backward'

    offset: float = parameter(
        0.0, unit='m', low=-5.0, high=5.0, scale=0.03, meaning='distance d ahead of the axle'
    )
