"""Three robots of the peer plant, and the wrong models that are declared of them."""

from dataclasses import dataclass

import numpy as np
from peer_forces import GRAVITY
from peer_plant import Plant

from diffbot_sim.physics import Friction, Model, Robot

# How far mass, inertia and each friction coefficient of a declared model are off, either way.
WRONG = (0.15, 0.30)


@dataclass(frozen=True)
class Make:
    """A robot and what it is driven with.

    push: greatest force on a wheel [N]; fastest [m/s] and fastest_turn [rad/s] bound the twists
    of closed-loop drives; roughness: rms force of a rough floor on each wheel [N].
    """

    plant: Plant
    push: float
    fastest: float
    fastest_turn: float
    roughness: float

    @property
    def terminal(self) -> float:
        """Speed at the greatest force on both wheels [m/s]."""
        return (self.push - self.plant.coulomb) / self.plant.viscous


def _make(plant: Plant, push: float, fastest: float, fastest_turn: float) -> Make:
    return Make(plant, push, fastest, fastest_turn, 0.3 * plant.coulomb / 1.5)


MAKES = {
    'medium': _make(Plant(10.0, 0.4, 0.2, 0.08, 2.4, 1.5, 4.0, 25.0), 10.0, 1.0, 2.2),
    'small': _make(Plant(2.0, 0.016, 0.1, 0.033, 0.6, 0.4, 1.2, 30.0), 2.0, 0.7, 3.0),
    'large': _make(Plant(45.0, 3.6, 0.28, 0.15, 13.0, 9.0, 22.0, 20.0), 50.0, 1.1, 1.8),
}


def declared(make: Make, seed: int) -> Model:
    """Return a model of the robot without any effect, wrong by WRONG in all that is measured."""
    random, p = np.random.default_rng([seed, 1]), make.plant
    off = 1.0 + random.choice([-1.0, 1.0], 6) * random.uniform(*WRONG, 6)
    load = p.mass * GRAVITY / 2.0
    static, coulomb, viscous, stribeck = off[2:] * [p.static, p.coulomb, p.viscous, p.stribeck]
    robot = Robot(p.mass * off[0], p.inertia * off[1], 2.0 * p.half, p.radius)
    friction = Friction(
        'generalized',
        load,
        max(static, 1.05 * coulomb) / load,
        coulomb / load,
        viscous / load,
        stribeck,
    )
    return Model(robot, friction)


def exact(p: Plant) -> Model:
    """Return diffbot_sim's model of a plant without effects."""
    load = p.mass * GRAVITY / 2.0
    friction = (p.static / load, p.coulomb / load, p.viscous / load, p.stribeck)
    return Model(
        Robot(p.mass, p.inertia, 2.0 * p.half, p.radius), Friction('generalized', load, *friction)
    )
