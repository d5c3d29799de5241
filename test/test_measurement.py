"""Twists as odometry tells them: of the moment, or means since the sample before."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

from diffbot_sim.identification.fitting.predictor import NO_GAIN, predict
from diffbot_sim.identification.recordings.measurement import simulated
from diffbot_sim.identification.recordings.stretches import Stretch, thin, whole
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.effects.quadratic_drag import QuadraticDrag
from diffbot_sim.physics.model import Model
from diffbot_sim.physics.simulation import simulate
from diffbot_sim.physics.stages import pushed
from diffbot_sim.physics.state import State
from diffbot_sim.records import Commands, Odometry, Run

FORCE = np.random.default_rng(3).normal(4.0, 6.0, (40, 2))
FORCE[0] = 0.0  # it rests at first
COMMANDS = Commands(np.arange(0.0, 20.0, 0.5), FORCE)
B = Model().half_separation


def counted(time, means) -> Run:
    """Return a drive without noise, of which so much is told as the mean between two stamps."""
    moved = simulate(Model(), COMMANDS, time)
    rim = Model().robot.wheel_radius * moved.wheel_angle
    way = np.column_stack([rim.mean(axis=1), rim @ [0.5 / B, -0.5 / B]])
    mean = np.diff(way, axis=0) / np.diff(time)[:, None]
    twist = np.where(means, mean, moved.twist[1:])
    return Run('counted', COMMANDS, Odometry(time[1:], twist, moved.pose[1:], means))


def from_rest(run: Run) -> Stretch:
    (stretch,) = whole([run])
    return replace(stretch, start=State())


@compiled
def in_mud(at, load, coefficient):
    return pushed(load, -coefficient * at.x**2 * at.v, 0.0)


@dataclass(frozen=True)
class Mud(QuadraticDrag):
    """A drag that is the stronger the farther away the robot is."""

    name = 'mud'
    kernel = in_mud
    is_of_place = True


def test_what_depends_on_the_place_is_predicted_where_the_robot_is() -> None:
    muddy, time = Model(effects=(Mud(2.0),)), np.arange(0.0, 20.0, 0.05)
    moved = simulate(muddy, COMMANDS, time)
    stretch = from_rest(Run('muddy', COMMANDS, Odometry(time, moved.twist, moved.pose)))
    assert np.abs(simulate(Model(), COMMANDS, time).twist - moved.twist).max() > 0.1
    assert np.abs(predict(muddy, stretch, NO_GAIN).innovation).max() < 1e-5


def test_at_a_single_stamp_the_mean_is_the_speed_that_it_starts_with() -> None:
    stretch = from_rest(counted(np.arange(0.0, 20.0, 0.1), (True, True)))
    start = State(v=0.3, omega=-0.2)
    told = simulated(Model(), stretch, stretch.time[-1:], start, 0.01)
    assert told.twist == pytest.approx(np.array([[0.3, -0.2]]))


@pytest.mark.parametrize('means', [(False, False), (True, False), (True, True)])
@pytest.mark.parametrize('interval', [0.02, 0.1, 0.25])
def test_what_is_counted_is_what_is_predicted(means, interval: float) -> None:
    stretch = from_rest(counted(np.arange(0.0, 20.0, interval), means))
    assert np.abs(predict(Model(), stretch, NO_GAIN).innovation).max() < 1e-5


def test_twists_of_the_moment_are_not_what_counted_ways_tell() -> None:
    stretch = from_rest(counted(np.arange(0.0, 20.0, 0.1), (True, True)))
    moved = simulate(Model(), COMMANDS, stretch.time, stretch.start)
    assert np.abs(moved.twist - stretch.twist).max() > 0.02


@pytest.mark.parametrize('means', [(False, False), (True, False), (True, True)])
def test_simulation_and_prediction_tell_the_same(means) -> None:
    stretch = from_rest(counted(np.arange(0.0, 20.0, 0.05), means))
    told = simulated(Model(), stretch, stretch.time, stretch.start, 0.02).twist
    foretold = stretch.twist - predict(Model(), stretch, NO_GAIN).innovation
    assert told[1:] == pytest.approx(foretold[1:], abs=1e-5)


def test_means_over_several_intervals_are_means_of_their_means() -> None:
    fast, slow = (np.arange(0.0, 20.0 + 1e-9, interval) for interval in (0.0025, 0.01))
    thinned, wanted = thin(counted(fast, (True, True))).odometry, counted(slow, (True, True))
    assert thinned.means == (True, True)
    assert thinned.time == pytest.approx(wanted.odometry.time)
    assert thinned.twist == pytest.approx(wanted.odometry.twist, abs=1e-5)
    assert thinned.pose == pytest.approx(wanted.odometry.pose, abs=1e-5)
