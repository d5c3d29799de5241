"""A table over each wheel's own speed or force."""

import numpy as np

from diffbot_sim.physics import Friction, Model, simulate
from diffbot_sim.physics.effects.empirical_force import POINTS
from diffbot_sim.physics.effects.empirical_wheel_force import EmpiricalWheelForce
from diffbot_sim.physics.state import State
from diffbot_sim.records import Array, Commands

SMOOTH = Friction('none')


def driven(effect: EmpiricalWheelForce, right: float, left: float, start: State) -> Array:
    commands = Commands(np.zeros(1), np.array([[right, left]]))
    run = simulate(
        Model(friction=SMOOTH, effects=(effect,)), commands, np.array([0.0, 0.1]), start
    )
    return run.traction[0]


def ramp(low: float, high: float) -> list[float]:
    return [float(x) for x in np.linspace(low, high, POINTS)]


def test_each_wheel_looks_its_own_force_up() -> None:
    table = EmpiricalWheelForce('wheels', 'wheel_force', -10.0, 10.0, *ramp(-1.0, 1.0))
    np.testing.assert_allclose(driven(table, 5.0, -2.0, State()), [5.5, -2.2])


def test_difference_pushes_the_left_wheel_the_other_way() -> None:
    table = EmpiricalWheelForce('difference', 'wheel_speed', -1.0, 1.0, *ramp(-1.0, 1.0))
    np.testing.assert_allclose(driven(table, 0.0, 0.0, State(v=0.5)), [0.5, -0.5])


def test_beyond_its_ends_a_table_stays_as_it_ends() -> None:
    table = EmpiricalWheelForce('wheels', 'wheel_speed', -1.0, 1.0, *ramp(-1.0, 1.0))
    np.testing.assert_allclose(driven(table, 0.0, 0.0, State(v=3.0)), [1.0, 1.0])
