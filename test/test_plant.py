"""The live robot: stepped tick by tick it is the simulated one."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from motion import commands, drives, models, numbers, push

from diffbot_sim.physics import Friction, Model, Plant, Robot, simulate
from diffbot_sim.physics.effects.actuator_lag import ActuatorLag
from diffbot_sim.physics.effects.quadratic_drag import QuadraticDrag
from diffbot_sim.physics.effects.yaw_friction import YawFriction
from diffbot_sim.physics.state import State

STATIC = Friction().law().static
# Powers of 2, so that the sums of ticks are exact.
TICK, STEP = 2.0**-6, 2.0**-9


def rolling() -> Plant:
    """Return a robot that has driven a curve for a second."""
    plant = Plant(Model())
    plant.step(8.0, 6.0, 1.0)
    return plant


def test_new_plant_rests_at_the_origin():
    plant = Plant(Model())
    assert (plant.time, plant.pose, plant.twist) == (0.0, (0.0, 0.0, 0.0), (0.0, 0.0))
    assert plant.wheel_angle == plant.wheel_speed == plant.friction == (0.0, 0.0)


def test_plant_starts_where_it_is_told():
    plant = Plant(Model(), start=State(1.0, 2.0, 3.0, 0.5, -0.5))
    assert plant.pose == (1.0, 2.0, 3.0)
    assert plant.twist == pytest.approx((0.5, -0.5))


@given(model=models((ActuatorLag(0.05), YawFriction(0.2, 0.1))), rows=drives())
def test_ticks_give_the_bits_of_a_simulation(model, rows):
    forces = [(0.0, 0.0, 0.0), *[(TICK + time, right, left) for time, right, left in rows]]
    times = np.arange(16 * len(rows) + 2) * TICK
    run = simulate(model, commands(*forces), times, max_step=STEP)
    plant = Plant(model, max_step=STEP)
    for k, time in enumerate(times[1:], start=1):
        _, right, left = forces[(k + 14) // 16]
        plant.step(right, left, TICK)
        assert plant.time == time
        assert (*plant.pose, *plant.twist) == (*run.pose[k], *run.twist[k])
        assert (*plant.wheel_angle, *plant.wheel_speed) == (
            *run.wheel_angle[k],
            *run.wheel_speed[k],
        )


@given(right=numbers(-0.99, 0.99), left=numbers(-0.99, 0.99))
def test_command_shows_what_friction_holds_without_advancing(right, left):
    plant = Plant(Model())
    plant.command(right * STATIC, left * STATIC)
    assert plant.traction == (right * STATIC, left * STATIC)
    assert plant.friction == pytest.approx(plant.traction)
    assert (plant.time, plant.pose) == (0.0, (0.0, 0.0, 0.0))


def test_command_of_a_rolling_robot_changes_neither_pose_nor_speed():
    plant = rolling()
    before = plant.pose, plant.twist, plant.wheel_angle, plant.time
    plant.command(-20.0, 20.0)
    assert (plant.pose, plant.twist, plant.wheel_angle, plant.time) == before
    assert plant.traction == (-20.0, 20.0)


def test_new_model_keeps_pose_motion_and_time():
    plant = rolling()
    pose, twist, angle, time = plant.pose, plant.twist, plant.wheel_angle, plant.time
    plant.model = Model(Robot(mass=20.0), effects=(QuadraticDrag(5.0),))
    assert (plant.pose, plant.wheel_angle, plant.time) == (pose, angle, time)
    assert plant.twist == pytest.approx(twist, rel=1e-15)


def test_new_wheel_separation_keeps_the_twist():
    plant = rolling()
    twist = plant.twist
    plant.model = Model(Robot(wheel_separation=0.8))
    assert plant.twist == pytest.approx(twist, rel=1e-15)


def test_new_model_acts_from_then_on():
    plain, dragged = rolling(), rolling()
    dragged.model = Model(effects=(QuadraticDrag(50.0),))
    for plant in (plain, dragged):
        plant.step(8.0, 6.0, 0.5)
    assert dragged.twist[0] < 0.9 * plain.twist[0]


@given(separation=numbers(0.05, 2.0))
def test_new_model_leaves_a_stuck_wheel_stuck(separation):
    model = Model(Robot(inertia=10.0 * separation**2 / 4.0, wheel_separation=separation))
    plant = Plant(model)
    plant.step(1.5 * STATIC, 0.0, 1.0)
    assert plant.wheel_speed[0] > 0.0 == plant.wheel_speed[1]
    plant.model = model.with_effect(QuadraticDrag(1.0))
    assert plant.wheel_speed[1] == 0.0


def test_new_model_takes_up_the_force_that_acts():
    """A lag that appears has had the present command for long."""
    plant = rolling()
    plant.model = plant.model.with_effect(ActuatorLag(0.5))
    assert plant.traction == (8.0, 6.0)
    plant.step(0.0, 0.0, 0.5)
    assert plant.traction == pytest.approx((8.0 / np.e, 6.0 / np.e))


def test_reset_starts_afresh():
    plant, fresh = rolling(), Plant(Model())
    plant.reset()
    for each in (plant, fresh):
        assert each.traction == (0.0, 0.0)
        each.step(5.0, 4.0, 0.5)
    assert (plant.time, plant.pose, plant.friction) == (fresh.time, fresh.pose, fresh.friction)


def test_reset_can_put_the_robot_elsewhere():
    plant = rolling()
    plant.reset(State(1.0, -1.0, 0.5, 0.2, 0.0))
    assert plant.pose == (1.0, -1.0, 0.5)
    assert plant.twist == (0.2, 0.0)


def test_friction_model_can_be_changed_while_driving():
    plant = rolling()
    plant.model = replace(plant.model, friction=Friction('none'))
    assert plant.friction == (0.0, 0.0)
    v = plant.twist[0]
    plant.step(5.0, 5.0, 1.0)
    assert plant.twist[0] == pytest.approx(v + 1.0)


@given(duration=numbers(1e-9, 0.1))
def test_a_tick_of_any_length_moves_a_rolling_robot(duration):
    plant = Plant(Model(friction=Friction('none')), start=State(v=1.0))
    plant.step(0.0, 0.0, duration)
    assert plant.pose[0] == pytest.approx(duration)
    assert push(plant.model, 0.0, 0.0, duration, every=duration).time[-1] == plant.time
