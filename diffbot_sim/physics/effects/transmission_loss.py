"""Gears that rub the more, the more they carry."""

from dataclasses import dataclass

from diffbot_sim.parameters import parameter
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.effects.effect import Effect
from diffbot_sim.physics.stages import Law, Motion, Stage


@compiled
def loaded(at: Motion, law: Law, loss: float) -> Law:
    """Let the gear lose a share of the force that it carries."""
    return Law(
        law.side,
        law.direction,
        law.traction,
        law.burden,
        law.static,
        law.coulomb,
        law.excess,
        law.viscous,
        law.stribeck,
        law.lost + loss * abs(law.traction),
    )


@dataclass(frozen=True)
class TransmissionLoss(Effect):
    """Dry friction of each wheel grows by loss·|F|, F being the force that drives the wheel.

    A gear that drives gives 1 - loss of the force, and one that brakes 1 + loss.
    """

    name = 'transmission_loss'
    meaning = 'gear friction that grows with the force carried: a share of it is lost'
    source = 'friction depending on load: Hamon, Gautier, Garrec (IROS 2010)'
    stage = Stage.WHEEL_FRICTION
    kernel = loaded
    dissipative = True
    # On the EMPS axis it displaces what is known to be there, and then neither name stands.
    is_sought = False
    guesses = ((0.1,),)
    excitation = 'the same speeds with weak and with strong forces: brisk starts and stops'

    loss: float = parameter(
        0.0, unit='-', low=0.0, high=0.95, scale=0.1, meaning='share of the force that is lost'
    )
