"""One compiled set for many models: what a model lacks is there, but neutral."""

from functools import cache

from diffbot_sim.physics.effects import Effect, laws
from diffbot_sim.physics.model import Model


def embedded(model: Model) -> Model:
    """Return a model that moves alike, to the bit, and has every law of the library.

    Each set of effects is compiled once; a search over many sets would compile for longer than it
    simulates. All neutral effects together cost less than the robot itself and change nothing.
    """
    present = {effect.name for effect in model.effects}
    absent = [effect for effect in _neutral() if effect.name not in present]
    return Model(model.robot, model.friction, (*model.effects, *absent))


@cache
def _neutral() -> tuple[Effect, ...]:
    return tuple(kind() for kind in laws().values())
