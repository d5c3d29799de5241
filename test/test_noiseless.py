"""Recordings without noise: what a simulator of another make leaves is nothing of a robot."""

import numpy as np
import pytest
from counting import counted
from euler_robot import driven_by_euler
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.identification import identify
from diffbot_sim.identification.recordings.lateness import timely
from diffbot_sim.identification.recordings.noiseless import (
    is_noiseless,
    odometry_noise,
    with_noise,
)
from diffbot_sim.identification.result import ErrorNorm
from diffbot_sim.physics import Friction, Model, Robot
from diffbot_sim.physics.effects.actuator_delay import ActuatorDelay
from diffbot_sim.physics.effects.slope import Slope
from diffbot_sim.physics.effects.yaw_friction import YawFriction

DECLARED = Model(
    Robot(mass=11.5, inertia=0.34), Friction(mu_coulomb=0.037, mu_static=0.055, mu_viscous=0.07)
)
KINDS = (Slope, YawFriction, ActuatorDelay)


def test_slope_of_a_coarse_simulator_is_named_alone() -> None:
    result = identify([driven_by_euler(0.01, seed=1, duration=40.0)], DECLARED, kinds=KINDS)
    (slope,) = result.effects
    assert slope.name == 'slope'
    assert slope.parameters['grade_x'].value == pytest.approx(-0.01, rel=0.1)
    assert result.unexplained is None
    assert result.added_noise is not None
    assert result.timings == ()


def test_what_is_explained_to_the_end_is_told_as_it_is() -> None:
    exact = Surroundings(v_noise=0.0, omega_noise=0.0)
    hidden = Model(effects=(Slope(grade_x=0.01),))
    run = rehearse(hidden, random_forces(1, 60.0, -9.0, 11.0), exact, 1)
    result = identify([run], Model(), kinds=KINDS)
    assert result.effects[0].parameters['grade_x'].value == pytest.approx(0.01, rel=1e-3)
    assert result.added_noise is None


def test_added_noise_is_that_of_a_good_odometry() -> None:
    run, noise = driven_by_euler(0.0, seed=2, duration=30.0), odometry_noise(0.2)
    added = with_noise(run, noise).odometry.twist - run.odometry.twist
    assert np.std(added, axis=0) == pytest.approx(noise, rel=0.1)


def test_same_recording_gets_the_same_noise_and_another_one_other() -> None:
    one, other = (driven_by_euler(0.0, seed, 5.0) for seed in (1, 2))
    noise = odometry_noise(0.2)
    first, again, third = (with_noise(run, noise).odometry.twist for run in (one, one, other))
    assert np.array_equal(first, again)
    added, elsewhere = first - one.odometry.twist, third - other.odometry.twist
    assert abs(np.corrcoef(added[:, 0], elsewhere[:, 0])[0, 1]) < 0.3


def test_encoders_are_not_without_noise() -> None:
    noise = odometry_noise(0.2)
    assert is_noiseless(ErrorNorm(1e-4, 1e-4), noise)
    assert not is_noiseless(ErrorNorm(1e-3, 1e-4), noise)


def test_added_noise_is_not_taken_from_the_pose_again() -> None:
    exact = Surroundings(v_noise=0.0, omega_noise=0.0)
    run = counted(rehearse(Model(), random_forces(1, 60.0, -9.0, 11.0), exact, 1), 10)
    noisy = with_noise(timely(run), odometry_noise(0.2))
    assert timely(run) is not run
    assert timely(noisy) is noisy
