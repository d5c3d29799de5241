"""The plant that judges identification: closed forms, rest, and agreement with our simulator."""

import numpy as np
import pytest
from peer_drives import DRIVES
from peer_plant import Plant
from peer_recording import Recording, record
from peer_robots import MAKES, exact

from diffbot_sim.physics import simulate
from diffbot_sim.records import Run

QUIET = Recording(duration=4.0, v_noise=0.0, omega_noise=0.0)
BARE = Plant(10.0, 0.4, 0.2, 0.08, 0.0, 0.0, 0.0, 1.0)


def driven(plant: Plant, right: float, left: float, until: float = 4.0) -> Run:
    force = np.array([right, left])
    return record(plant, lambda k, measured: force * (k < until * 50.0), QUIET, 0)


def test_coulomb_friction_stops_a_robot_on_the_way_that_energy_gives():
    run = driven(BARE._replace(static=1.5, coulomb=1.5), 4.0, 4.0, until=1.0)
    pushed = 0.5 * (8.0 - 3.0) / 10.0
    assert run.odometry.pose[-1, 0] == pytest.approx(pushed + 0.5**2 * 10.0 / 6.0, rel=1e-3)
    assert run.odometry.twist[-1, 0] == 0.0


def test_viscous_friction_leads_to_the_terminal_speed():
    run = driven(BARE._replace(static=1.5, coulomb=1.5, viscous=20.0), 6.0, 6.0)
    assert run.odometry.twist[-1, 0] == pytest.approx((6.0 - 1.5) / 20.0, rel=1e-4)


def test_opposite_forces_turn_as_eq_11_says_about_the_axle():
    run = driven(BARE._replace(ahead=0.0), 1.0, -1.0)
    assert run.odometry.twist[50, 1] == pytest.approx(2.0 * 0.2 / 0.4, rel=1e-9)


def test_centre_of_gravity_ahead_trades_energy_between_way_and_turn():
    run = driven(BARE._replace(ahead=0.05), 1.0, 0.4, until=1.0)
    v, omega = run.odometry.twist[60:].T
    energy = 10.0 * v**2 + (0.4 + 10.0 * 0.05**2) * omega**2
    assert np.ptp(omega) > 0.01
    np.testing.assert_allclose(energy, energy[0], rtol=1e-3)


def test_tether_and_waves_of_the_ground_keep_energy():
    run = driven(
        BARE._replace(tether=6.0, tether_slack=0.1, wave=0.02, wave_length=0.5), 1.0, 1.0, 1.0
    )
    v, x = run.odometry.twist[60:, 0], run.odometry.pose[60:, 0]
    height = 0.02 * 0.5 / (2.0 * np.pi) * (1.0 - np.cos(2.0 * np.pi * x / 0.5))
    energy = 5.0 * v**2 + 3.0 * np.maximum(np.abs(x) - 0.1, 0.0) ** 2 + 98.1 * height
    assert np.ptp(x) > 0.1
    np.testing.assert_allclose(energy, energy[0], rtol=2e-3)


def test_wind_that_turns_full_circle_leaves_a_free_robot_as_fast_as_before():
    run = driven(BARE._replace(wind=2.0, wind_turn=np.pi), 0.0, 0.0)
    assert run.odometry.twist[25, 0] == pytest.approx(0.2 / np.pi, abs=1e-3)
    assert run.odometry.twist[100, 0] == pytest.approx(0.0, abs=1e-3)


def test_force_below_static_friction_moves_nothing_at_all():
    plant = MAKES['medium'].plant._replace(yaw_dry=0.1, rise_x=0.001)
    run = driven(plant, 2.2, -2.2)
    assert not run.odometry.twist.any()
    assert not run.odometry.pose.any()


def test_wheels_creep_in_proportion_to_force_below_static_friction():
    run = driven(MAKES['medium'].plant._replace(creep=0.006), 0.8, 0.8)
    assert run.odometry.twist[-1, 0] == pytest.approx(0.006 * 0.8 / 2.4, rel=0.02)


def test_stuck_wheel_holds_while_the_other_slides():
    run = driven(MAKES['medium'].plant._replace(static=4.0), 6.0, 0.0)
    v, omega = run.odometry.twist[-1]
    assert v > 0.1
    assert v - 0.2 * omega == pytest.approx(0.0, abs=1e-15)


@pytest.mark.parametrize('cause', ['load', 'carpet'])
def test_friction_that_jumps_slows_down_more(cause):
    rubbing = BARE._replace(static=1.5, coulomb=1.5)
    jump = {
        'load': {'load_friction': 0.4, 'load_time': 1.5},
        'carpet': {'carpet': 0.4, 'carpet_time': 1.5},
    }
    v = driven(rubbing._replace(**jump[cause]), 8.0, 8.0, until=1.0).odometry.twist[:, 0]
    assert (v[80] - v[90]) / (v[55] - v[65]) == pytest.approx(1.4, rel=1e-9)


def test_delay_lag_and_dead_band_act_on_the_force():
    late = driven(BARE._replace(delay=0.05, deadband=1.0), 3.0, 3.0).odometry
    assert late.twist[-1, 0] == pytest.approx(2.0 * 2.0 / 10.0 * (late.time[-1] - 0.05), rel=1e-9)
    slow = driven(BARE._replace(lag=0.2), 3.0, 3.0).odometry
    assert slow.twist[-1, 0] == pytest.approx(0.6 * (slow.time[-1] - 0.2), rel=1e-3)


def test_force_in_steps_rounds_the_command():
    run = driven(BARE._replace(coarse=2.0), 2.9, 1.1)
    assert run.odometry.twist[-1, 0] == pytest.approx(0.4 * run.odometry.time[-1], rel=1e-9)


def test_push_acts_at_the_start_of_each_period():
    run = driven(BARE._replace(knock=5.0, knock_time=0.5, knock_period=2.0), 0.0, 0.0)
    gained = 5.0 / 10.0 * 0.5
    assert run.odometry.twist[[60, 190], 0] == pytest.approx([gained, 2.0 * gained], rel=1e-3)


def test_shoves_come_later_and_later_there_and_back():
    run = driven(BARE._replace(shove=5.0, shove_first=1.5), 0.0, 0.0)
    gained = 5.0 / 10.0 * 0.8
    at = np.searchsorted(run.odometry.time, (1.45, 2.35, 3.3))
    assert run.odometry.twist[at, 0] == pytest.approx([0.0, gained, 0.0], abs=1e-2)


def test_wheel_that_has_settled_needs_more_to_break_away():
    plant = BARE._replace(static=1.5, coulomb=1.5, settling=0.5)
    force = np.array([1.7, 1.7])
    soon, late = (
        record(plant, lambda k, measured, first=first: force * (k >= first), QUIET, 0)
        for first in (1, 100)
    )
    assert soon.odometry.twist[-1, 0] > 0.0
    assert late.odometry.twist[-1, 0] == 0.0


def test_load_that_swings_and_body_share_the_impulse():
    plant = BARE._replace(mass=8.0, swing_mass=2.0, swing_rate=1.0)
    v = driven(plant, 1.0, 1.0).odometry.twist[:, 0]
    time = np.arange(len(v)) / 50.0
    swung = 2.0 * np.pi * np.sqrt(10.0 / 8.0) * time
    share = (1.0 + 0.25 * np.sin(swung) / np.maximum(swung, 1e-9)) * 0.2 * time
    np.testing.assert_allclose(v, share, atol=2e-4)


def test_caster_costs_what_its_friction_takes_on_a_straight_way():
    plant = BARE._replace(caster_roll=1.0, caster_ahead=-0.3, caster_trail=0.04)
    run = driven(plant, 3.0, 3.0)
    assert run.odometry.twist[-1, 0] == pytest.approx(0.5 * run.odometry.time[-1], rel=0.01)


def test_caster_takes_energy_and_gives_none():
    pivot = {'caster_ahead': -0.3, 'caster_trail': 0.04}
    plant = BARE._replace(caster_roll=0.5, caster_swivel=0.05, **pivot)
    v, omega = driven(plant, 1.0, 0.4, until=1.0).odometry.twist[51:].T
    energy = 5.0 * v**2 + 0.2 * omega**2
    assert np.all(np.diff(energy) <= 1e-9)
    assert energy[-1] < 0.9 * energy[0]


@pytest.mark.parametrize('drive', DRIVES)
@pytest.mark.parametrize('make', MAKES)
def test_clean_drive_agrees_with_our_simulator_far_below_the_noise(make, drive):
    """Measured: rms below 0.04 mm/s and 0.7 mrad/s in 120 s, a tenth of the noise at most."""
    robot, how = MAKES[make], Recording(duration=30.0, v_noise=0.0, omega_noise=0.0)
    run = record(robot.plant, DRIVES[drive](robot, 1, 30.0, 50.0), how, 0)
    ours = simulate(exact(robot.plant), run.commands, run.odometry.time)
    missed = np.sqrt(np.mean((ours.twist - run.odometry.twist) ** 2, axis=0))
    assert (missed < [1e-4, 1e-3]).all()
    np.testing.assert_allclose(ours.pose, run.odometry.pose, atol=0.02)
