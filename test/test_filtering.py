"""Odometry that went through a low-pass filter on its way into the bag."""

from dataclasses import replace

import numpy as np
import pytest
from fits import without_pose
from hypothesis import given
from hypothesis import strategies as st
from rehearsal import Surroundings, random_forces, rehearse
from scipy.signal import lfilter

from diffbot_sim.identification import identify
from diffbot_sim.identification.fitting.coordinates import Space, point_of
from diffbot_sim.identification.fitting.filtering import filter_behind
from diffbot_sim.identification.fitting.fit import FIRST_GAINS, Fit, fit_prediction
from diffbot_sim.identification.recordings.filters import (
    Age,
    FirstOrder,
    told_each_sample,
    told_often,
    unfiltered,
)
from diffbot_sim.identification.recordings.stretches import split
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects.actuator_delay import ActuatorDelay
from diffbot_sim.physics.effects.actuator_lag import ActuatorLag
from diffbot_sim.records import Commands, Odometry, Run

LATENESS = (ActuatorDelay, ActuatorLag)


def filtered(run: Run, time_constant: float) -> Run:
    """Return what is left of a run's odometry behind a filter; the pose goes missing."""
    seen = run.odometry
    twist = seen.twist.copy()
    for k, passed in enumerate(-np.expm1(-np.diff(seen.time) / time_constant), start=1):
        twist[k] = twist[k - 1] + passed * (seen.twist[k] - twist[k - 1])
    return replace(run, odometry=Odometry(seen.time, twist, None))


def delay_of(time_constant: float) -> float:
    """Return by how much such a filter delays what changes slowly [s], told each 20 ms."""
    return FirstOrder(time_constant, told_each_sample).lateness(0.02)


def driven(effects: tuple, surroundings: Surroundings, seed: int = 3) -> Run:
    """Return three quarters of a minute of random forces."""
    return rehearse(
        Model(effects=effects), random_forces(seed, 45.0, -9.0, 11.0), surroundings, seed
    )


@given(time_constant=st.floats(0.005, 1.0), seed=st.integers(0, 9))
def test_what_was_filtered_comes_back(time_constant: float, seed: int) -> None:
    generator = np.random.default_rng(seed)
    time, twist = np.cumsum(generator.uniform(0.01, 0.1, 200)), generator.normal(size=(200, 2))
    run = Run('drive', Commands(time, twist), Odometry(time, twist, None))
    back = unfiltered(filtered(run, time_constant), FirstOrder(time_constant, told_each_sample))
    assert back.odometry.twist == pytest.approx(twist, abs=1e-9)


@pytest.mark.parametrize('interval', [0.01, 0.1])
def test_filter_that_is_told_often_passes_means_over_a_runs_own_interval(interval: float) -> None:
    time, still = interval * np.arange(50), np.zeros((50, 2))
    run = Run('drive', Commands(time, still), Odometry(time, still, None))
    age = time - unfiltered(run, FirstOrder(0.5, told_often)).odometry.time
    assert age == pytest.approx(0.5 * interval, rel=0.05)


@pytest.mark.parametrize('age', [told_each_sample, told_often])
def test_filter_delays_a_ramp_by_its_lateness(age: Age) -> None:
    time = np.arange(0.0, 5.0, 0.02)
    ramp = np.column_stack([time, 2.0 * time])
    run = Run('drive', Commands(time, ramp), Odometry(time, ramp, None))
    behind = FirstOrder(0.1, age)
    seen = unfiltered(run, behind).odometry
    assert seen.twist[-1, 0] - seen.time[-1] == pytest.approx(behind.lateness(0.02), rel=1e-6)


def test_filtered_twists_do_not_make_a_robot_late() -> None:
    answer = identify([filtered(driven((), Surroundings()), 0.06)], Model(), kinds=LATENESS)
    assert answer.verdict == 'nothing_missing'
    (timing,) = answer.timings
    assert timing.taken == 'filter'
    assert timing.lateness == pytest.approx(delay_of(0.06), rel=0.03)


def test_filter_that_is_told_often_does_not_make_a_robot_late() -> None:
    drive = random_forces(3, 45.0, -9.0, 11.0)
    often = Commands(np.arange(4 * len(drive.time)) * 0.005, np.repeat(drive.force, 4, axis=0))
    fast = filtered(rehearse(Model(), often, Surroundings(0.008, 0.016), 3), 0.03)
    seen = Odometry(fast.odometry.time[::4], fast.odometry.twist[::4], None)
    answer = identify([replace(fast, commands=drive, odometry=seen)], Model(), kinds=LATENESS)
    assert answer.verdict == 'nothing_missing'
    assert answer.timings[0].lateness == pytest.approx(0.03, rel=0.15)


@pytest.mark.parametrize(('lag', 'behind'), [(0.15, 0.05), (0.1, 0.02)])
def test_lag_of_the_actuators_is_told_from_that_of_a_filter(lag: float, behind: float) -> None:
    run = driven((ActuatorLag(lag),), Surroundings(), seed=5)
    answer = identify([filtered(run, behind)], Model(), kinds=LATENESS)
    (effect,) = answer.effects
    assert effect.name == 'actuator_lag'
    assert effect.parameters['time_constant'].value == pytest.approx(lag, rel=0.03)
    assert answer.timings[0].lateness == pytest.approx(delay_of(behind), rel=0.05)


def test_mean_over_many_samples_makes_no_robot_late() -> None:
    run = driven((), Surroundings())
    passed = lfilter(np.full(8, 0.125), [1.0], run.odometry.twist, axis=0)
    run = replace(run, odometry=Odometry(run.odometry.time, passed, None))
    answer = identify([run], Model(), kinds=LATENESS)
    assert (answer.verdict, answer.effects) == ('unexplained', ())


def test_twists_in_coarse_steps_went_through_no_filter() -> None:
    time = np.arange(0.0, 60.0, 0.02)
    slow = Commands(time, 5.0 * np.sin(np.outer(time, (0.5, 0.37))))
    run = rehearse(Model(effects=(ActuatorLag(0.15),)), slow, Surroundings(), 3)
    steps = 0.05 * np.round(run.odometry.twist / 0.05)
    run = replace(run, odometry=replace(run.odometry, twist=steps))
    answer = identify([run], Model(), kinds=LATENESS)
    assert 'filter' not in [it.taken for it in answer.timings]


@pytest.mark.parametrize('share', [1.0, 0.01])
def test_late_robot_is_not_taken_for_a_filter(share: float) -> None:
    run = driven((ActuatorLag(0.08),), Surroundings(0.004 * share, 0.008 * share))
    answer = identify([without_pose(run)], Model(), kinds=LATENESS)
    assert [effect.name for effect in answer.effects] == ['actuator_lag']
    assert not answer.timings


def coloured(run: Run, memory: float) -> Run:
    """Return a run with noise [4 mm/s, 8 mrad/s] that forgets within so many seconds."""
    seen, generator = run.odometry, np.random.default_rng(1)
    noise = generator.normal(size=seen.twist.shape) * [0.004, 0.008]
    for k, kept in enumerate(np.exp(-np.diff(seen.time) / memory), start=1):
        noise[k] = kept * noise[k - 1] + np.sqrt(1.0 - kept**2) * noise[k]
    return replace(run, odometry=Odometry(seen.time, seen.twist + noise, None))


@pytest.mark.parametrize('memory', [0.05, 0.1])
def test_late_robot_with_coloured_noise_is_not_taken_for_a_filter(memory: float) -> None:
    run = driven((ActuatorLag(0.08),), Surroundings(1e-5, 1e-5))
    answer = identify([coloured(run, memory)], Model(), kinds=LATENESS)
    assert [effect.name for effect in answer.effects] == ['actuator_lag']
    # Without a pose it may well be undecided whether the twists are means.
    assert 'filter' not in [it.taken for it in answer.timings]


def delayed(run: Run, delay: float) -> Fit:
    """Return a fit of a delay that starts at this one [s]."""
    space = Space(Model(), (ActuatorDelay,))
    start = np.append(Space(Model(), ()).prior(), point_of(ActuatorDelay, (delay,)))
    return fit_prediction(space, split([run])[0], start, FIRST_GAINS)


def test_lag_that_nobody_asked_about_is_not_taken_for_a_filter() -> None:
    run = driven((ActuatorLag(0.08),), Surroundings())
    assert filter_behind(delayed(run, 0.08)) is None


def test_true_pose_denies_a_filter_shorter_than_an_interval() -> None:
    run = driven((ActuatorDelay(0.008),), Surroundings(), seed=2)
    assert filter_behind(delayed(run, 0.008)) is None


def test_without_a_pose_a_filter_shorter_than_an_interval_is_believed() -> None:
    run = driven((ActuatorDelay(0.008),), Surroundings(), seed=2)
    behind = filter_behind(delayed(without_pose(run), 0.008))
    assert behind.filter.time_constant == pytest.approx(0.008, rel=0.1)
