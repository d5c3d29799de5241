"""Odometry behind filters of second order: Butterworth's, alpha-beta filters and the like."""

from dataclasses import replace

import numpy as np
import pytest
from fits import without_pose
from hypothesis import given
from hypothesis import strategies as st
from rehearsal import Surroundings, random_forces, rehearse
from scipy.signal import butter, lfilter

from diffbot_sim.identification import identify
from diffbot_sim.identification.finding import Question, begun_with
from diffbot_sim.identification.fitting.filter_fits import Ended
from diffbot_sim.identification.fitting.second_order import filter_seen_at_rest
from diffbot_sim.identification.fitting.standing_noise import polynomials
from diffbot_sim.identification.recordings.filters import SecondOrder
from diffbot_sim.identification.recordings.recordings import Recordings
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects.actuator_delay import ActuatorDelay
from diffbot_sim.physics.effects.actuator_lag import ActuatorLag
from diffbot_sim.records import Array, Odometry, Run

LATENESS = (ActuatorDelay, ActuatorLag)
BUTTERWORTH = butter(2, 4.0, fs=50.0)
# Its speed follows by 0.3 and its acceleration by 0.0529 of what is missed.
ALPHA_BETA = np.array([0.3, -0.2471]), np.array([1.0, -1.6471, 0.7])
COLOUR = np.array([1.0, 0.5]), np.array([1.0, -1.2, 0.45])


def driven(*effects: object, seed: int = 3, roughness: float = 0.0) -> Run:
    """Return three quarters of a minute of random forces, with stops, without a pose."""
    around = Surroundings(0.008, 0.016, roughness)
    forces = random_forces(seed, 45.0, -9.0, 11.0)
    return without_pose(rehearse(Model(effects=effects), forces, around, seed))


def told(run: Run, twist: Array) -> Run:
    """Return a run whose odometry tells other twists."""
    return replace(run, odometry=Odometry(run.odometry.time, twist, None))


def behind(run: Run, kind: tuple[Array, Array]) -> Run:
    """Return a run whose twists went through a filter."""
    return told(run, lfilter(*kind, run.odometry.twist, axis=0))


def lateness(kind: tuple[Array, Array], interval: float = 0.02) -> float:
    """Return by how much a filter delays what changes slowly [s]."""
    given, past = (float(np.arange(len(by)) @ by / by.sum()) for by in map(np.asarray, kind))
    return (given - past) * interval


def found_behind(run: Run) -> Ended | None:
    """Return the filter that is found behind a run of the declared model."""
    question = Question(Model(), LATENESS, lambda text: None)
    begun = begun_with(Recordings((run,), ()), question)
    return filter_seen_at_rest(begun.recalibrated, LATENESS)


@given(st.lists(st.floats(-0.9, 0.9), min_size=4, max_size=4), st.integers(0, 9))
def test_what_went_through_second_order_comes_back(point: list[float], seed: int) -> None:
    past, given_ = (tuple(map(float, by)) for by in polynomials(np.array(point)))
    known = SecondOrder(past, given_, 0.02, 0.0)
    twist = np.random.default_rng(seed).normal(size=(200, 2))
    twist[:9] = twist[0]
    let_through = np.array(given_) * known.at_once(0.02)
    passed = lfilter(let_through, past, twist - twist[0], axis=0) + twist[0]
    assert known.undone(0.02 * np.arange(200.0), passed)[1] == pytest.approx(twist, abs=1e-6)


def test_second_order_delays_a_ramp_by_its_lateness() -> None:
    known = SecondOrder((1.0, -1.2, 0.45), (1.0, 0.5, 0.0), 0.02, 0.004)
    time = np.arange(0.0, 5.0, 0.02)
    stamps, given_ = known.undone(time, np.column_stack([time, 2.0 * time]))
    assert given_[-1, 0] - stamps[-1] == pytest.approx(known.lateness(0.02), rel=1e-6)


@pytest.mark.parametrize('kind', [BUTTERWORTH, ALPHA_BETA], ids=['Butterworth', 'alpha-beta'])
def test_filter_of_second_order_makes_no_robot_late(kind: tuple[Array, Array]) -> None:
    answer = identify([behind(driven(), kind)], Model(), kinds=LATENESS)
    assert answer.verdict == 'nothing_missing'
    (timing,) = answer.timings
    assert timing.taken == 'filter'
    assert timing.lateness == pytest.approx(lateness(kind), abs=0.004)


@pytest.mark.parametrize('late', [ActuatorLag(0.09), ActuatorDelay(0.1)], ids=lambda e: e.name)
def test_late_robot_is_told_behind_second_order(late: ActuatorLag | ActuatorDelay) -> None:
    answer = identify([behind(driven(late), BUTTERWORTH)], Model(), kinds=LATENESS)
    (effect,) = answer.effects
    assert effect.name == late.name
    (value,) = (parameter.value for parameter in effect.parameters.values())
    assert value == pytest.approx(*late.values, rel=0.05)


def test_filter_is_found_on_a_rough_floor() -> None:
    filtered = found_behind(behind(driven(roughness=0.3), BUTTERWORTH))
    assert filtered is not None
    assert filtered.delay == pytest.approx(lateness(BUTTERWORTH), abs=0.006)


@pytest.mark.parametrize('late', [(), (ActuatorLag(0.08),), (ActuatorDelay(0.1),)])
def test_coloured_noise_is_no_filter(late: tuple[object, ...]) -> None:
    run = driven(*late)
    shocks = np.random.default_rng(1).normal(size=run.odometry.twist.shape)
    noise = lfilter(*COLOUR, shocks, axis=0) * [0.004, 0.008]
    assert found_behind(told(run, run.odometry.twist + noise)) is None


def test_white_noise_speaks_for_no_filter() -> None:
    assert found_behind(driven(ActuatorLag(0.08))) is None


def test_first_order_is_left_to_those_who_look_for_it() -> None:
    assert found_behind(behind(driven(), (np.array([0.4]), np.array([1.0, -0.6])))) is None


def test_filter_of_odometry_that_comes_unevenly_is_not_told() -> None:
    run = behind(driven(), BUTTERWORTH)
    seen = run.odometry
    kept = np.random.default_rng(1).uniform(size=len(seen.time)) > 0.1
    uneven = replace(run, odometry=Odometry(seen.time[kept], seen.twist[kept], None))
    assert found_behind(uneven) is None
