"""actuator_delay: forces act later, to the sub-sample, and nothing else changes."""

import numpy as np
import pytest
from motion import commands, push, table

from diffbot_sim.physics import Friction, Model, Plant, Robot, simulate
from diffbot_sim.physics.effects.actuator_delay import ActuatorDelay
from diffbot_sim.records import Commands

SMOOTH = Friction('none')
STEP = commands((-1.0, 0.0, 0.0), (0.0, 5.0, 4.0))


def test_speed_grows_from_the_moment_the_force_arrives():
    run = simulate(Model(friction=SMOOTH, effects=(ActuatorDelay(0.1234),)), STEP, np.arange(3.0))
    expected = 9.0 / 10.0 * np.maximum(run.time - 0.1234, 0.0)
    np.testing.assert_allclose(run.twist[:, 0], expected, rtol=1e-12)


@pytest.mark.parametrize('late', [0.01, 0.0371, 0.2])
def test_delayed_motion_is_that_of_commands_given_later(late):
    times, rows = np.linspace(0.0, 4.0, 41), np.array([[0.0, 0.0], [9.0, 6.0], [-4.0, 5.0]])
    given = Commands(np.array([-1.0, 0.5, 2.0]), rows)
    later = Commands(given.time + np.array([0.0, late, late]), rows)
    delayed = simulate(Model(effects=(ActuatorDelay(late),)), given, times)
    np.testing.assert_array_equal(table(delayed), table(simulate(Model(), later, times)))


def test_live_robot_takes_commands_as_late():
    model, stamps = Model(effects=(ActuatorDelay(0.033),)), np.linspace(0.0, 2.0, 201)
    plant, speeds = Plant(model), []
    for stamp in stamps:
        speeds.append(plant.twist[0])
        force = 6.0 if stamp < 1.0 else -3.0
        plant.step(force, force, 0.01)
    force = np.where(stamps < 1.0, 6.0, -3.0)
    given = Commands(np.insert(stamps, 0, -1.0), np.column_stack([np.insert(force, 0, 0.0)] * 2))
    np.testing.assert_allclose(speeds, simulate(model, given, stamps).twist[:, 0], atol=1e-9)


def test_command_that_is_held_for_ever_is_not_late():
    late = push(Model(effects=(ActuatorDelay(0.3),)), 5.0, 5.0, 2.0)
    np.testing.assert_array_equal(late.pose, push(Model(), 5.0, 5.0, 2.0).pose)


def test_the_first_command_is_late_too_where_none_was_there_before():
    stamps, first = np.arange(0.0, 2.0, 0.01), (0.5, 6.0, 6.0)
    late = simulate(Model(effects=(ActuatorDelay(0.1),)), commands(first), stamps)
    later = simulate(Model(), commands((0.6, 6.0, 6.0)), stamps)
    np.testing.assert_array_equal(table(late), table(later))


def test_forces_on_their_way_arrive_where_something_else_of_a_live_robot_changes():
    plant = Plant(Model(friction=SMOOTH, effects=(ActuatorDelay(0.1),)))
    plant.step(5.0, 5.0, 0.05)
    plant.model = Model(Robot(mass=5.0), SMOOTH, (ActuatorDelay(0.1),))
    plant.step(0.0, 0.0, 0.15)
    assert plant.twist[0] == pytest.approx(0.05 * 2.0 * 5.0 / 5.0)


def test_forces_on_their_way_are_dropped_with_another_delay():
    plant = Plant(Model(friction=SMOOTH, effects=(ActuatorDelay(0.1),)))
    plant.step(5.0, 5.0, 0.05)
    plant.model = Model(friction=SMOOTH, effects=(ActuatorDelay(0.2),))
    plant.step(0.0, 0.0, 0.3)
    assert plant.twist[0] == 0.0
