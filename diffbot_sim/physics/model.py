"""The model: robot, wheel friction and effects, frozen."""

from dataclasses import dataclass, field, replace
from functools import cached_property
from math import prod

import numpy as np

from diffbot_sim.physics.effects import Effect
from diffbot_sim.physics.friction import Friction
from diffbot_sim.physics.robot import Robot
from diffbot_sim.records import Array


@dataclass(frozen=True)
class Model:
    """What is simulated, fitted and written to YAML.

    effects are kept in order of evaluation (stage, then name), whatever the order given.
    """

    robot: Robot = field(default_factory=Robot)
    friction: Friction = field(default_factory=Friction)
    effects: tuple[Effect, ...] = ()

    def __post_init__(self) -> None:
        ordered = sorted(self.effects, key=lambda effect: (effect.stage, effect.name))
        object.__setattr__(self, 'effects', tuple(ordered))

    def with_effect(self, effect: Effect) -> 'Model':
        """Return a model that has this effect, in place of one of the same name."""
        return replace(
            self.without(effect.name), effects=(*self.without(effect.name).effects, effect)
        )

    def without(self, name: str) -> 'Model':
        """Return a model that lacks the effect of this name."""
        return replace(self, effects=tuple(e for e in self.effects if e.name != name))

    @cached_property
    def kinds(self) -> tuple[type[Effect], ...]:
        """The laws of its effects, in order of evaluation."""
        return tuple(type(effect) for effect in self.effects)

    @cached_property
    def half_separation(self) -> float:
        """Distance b from the middle to a wheel [m], as effects let it act."""
        return self.robot.half_separation * prod(effect.track for effect in self.effects)

    def pack(self) -> Array:
        """Return what compiled code reads: the numbers that `instant` names, then the effects'."""
        robot, law = self.robot, self.friction.law()
        rubbing = (law.static, law.coulomb, law.excess, law.viscous, law.stribeck)
        body = (robot.mass, robot.inertia, self.half_separation, robot.wheel_radius)
        tail = [value for effect in self.effects for value in effect.values]
        return np.array([*body, *rubbing, *tail], dtype=np.float64)
