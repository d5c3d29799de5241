"""One compiled set for many models: what a model lacks is there, but neutral."""

from functools import cache

from diffbot_sim.physics.effects import Effect, sought_effects
from diffbot_sim.physics.model import Model


def embedded(model: Model) -> Model:
    """Return a model that moves alike, to the bit, in one of few compiled sets.

    Each set of effects is compiled once; a search over many sets would compile for longer than it
    simulates. So several effects stand among all others, neutral: those change nothing, and cost
    about half as much as the robot. One alone, which is tried most often, has a set of its own.
    """
    if len(model.effects) <= 1:
        return model
    present = {effect.name for effect in model.effects}
    absent = [effect for effect in _neutral() if effect.name not in present]
    return Model(model.robot, model.friction, (*model.effects, *absent))


@cache
def _neutral() -> tuple[Effect, ...]:
    return tuple(kind() for kind in sought_effects().values())
