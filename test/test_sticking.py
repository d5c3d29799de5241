"""Sticking is exact: a wheel at rest has speed 0.0 for as long as friction holds it."""

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st
from motion import drive, drives, forces, frictions, models, numbers, push, robots, starts, table

from diffbot_sim.physics import Friction, Model, Robot
from diffbot_sim.physics.effects.actuator_lag import ActuatorLag
from diffbot_sim.physics.effects.yaw_friction import YawFriction
from diffbot_sim.physics.friction import MODELS
from diffbot_sim.physics.state import State

NOMINAL = Model()
STATIC = NOMINAL.friction.law().static
COULOMB = NOMINAL.friction.law().coulomb
# Inertia below and above m b², where the wheels push and pull each other through the body.
COMPACT, WIDE = Robot(inertia=0.1), Robot(inertia=0.9)
SLOTTED = Model(effects=(YawFriction(dry=0.3),))


def coupling(robot: Robot) -> float:
    """Return B / A: what reaches a wheel of the force on the other."""
    linear, angular = 1.0 / robot.mass, robot.half_separation**2 / robot.inertia
    return (linear - angular) / (linear + angular)


@given(model=models(), x=numbers(-1e3, 1e3), heading=numbers(-7.0, 7.0))
def test_robot_at_rest_stays_at_rest(model, x, heading):
    run = push(model, 0.0, 0.0, 2.0, start=State(x, -x, heading))
    assert (run.pose == (x, -x, heading)).all()
    for still in (run.twist, run.wheel_speed, run.wheel_angle, run.friction):
        assert not still.any()


@pytest.mark.parametrize('share', [0.99, -0.99])
def test_force_just_below_static_friction_moves_nothing_in_1000_seconds(share):
    run = push(NOMINAL, share * STATIC, share * STATIC, 1000.0, every=100.0)
    assert not run.pose.any()
    assert not run.wheel_speed.any()


@settings(max_examples=10)
@given(robot=robots(), sign=st.sampled_from([1.0, -1.0]))
def test_wheel_held_just_below_static_friction_stays_1000_seconds_while_the_other_slides(
    robot, sign
):
    """Where J < m b² the sliding wheel can only unload it."""
    assume(coupling(robot) <= 0.0)
    run = push(Model(robot), sign * 1.5 * STATIC, sign * 0.99 * STATIC, 1000.0, every=100.0)
    assert (sign * run.wheel_speed[1:, 0] > 0.0).all()
    assert not run.wheel_speed[:, 1].any()
    assert not run.wheel_angle[:, 1].any()


SHARES = numbers(-1.5, 1.5) | st.sampled_from([-1.001, -0.999, 0.999, 1.001])


@given(model=models(), right=SHARES, left=SHARES, step=st.floats(1e-4, 1.0))
def test_whether_a_robot_rests_depends_on_the_forces_and_not_on_the_step(model, right, left, step):
    static, most = model.friction.law().static, max(abs(right), abs(left))
    assume(static > 0.0 and abs(most - 1.0) > 1e-9)
    run = push(model, right * static, left * static, 1.0, max_step=step)
    assert run.wheel_speed.any() == (most > 1.0)


@given(robot=robots(), friction=frictions(), right=numbers(-0.99, 0.99), left=numbers(-0.99, 0.99))
def test_friction_that_holds_equals_the_force_that_pushes(robot, friction, right, left):
    static = friction.law().static
    run = push(Model(robot, friction), right * static, left * static, 1.0)
    assert not run.wheel_speed.any()
    np.testing.assert_allclose(run.friction, run.traction, rtol=1e-12, atol=1e-12 * static + 1e-99)


@given(excess=st.floats(1.001, 10.0), sign=st.sampled_from([1.0, -1.0]))
def test_force_above_static_friction_moves_the_robot_its_way(excess, sign):
    run = push(NOMINAL, sign * excess * STATIC, sign * excess * STATIC, 1.0)
    assert (sign * run.wheel_speed[1:] > 0.0).all()


@given(robot=robots(), share=numbers(0.05, 0.95), sign=st.sampled_from([1.0, -1.0]))
def test_stuck_left_wheel_stays_at_zero_while_the_right_one_slides(robot, share, sign):
    """Its reaction F_L + (B/A) n_R stays within ±F_s from breakaway to terminal speed."""
    most = coupling(robot) * (1.5 * STATIC - COULOMB)
    low, high = -STATIC - min(most, 0.0), STATIC - max(most, 0.0)
    assume(low < high)
    left = low + share * (high - low)
    run = push(Model(robot), sign * 1.5 * STATIC, sign * left, 5.0)
    assert not run.wheel_speed[:, 1].any()
    assert not run.wheel_angle[:, 1].any()
    assert (sign * run.wheel_speed[1:, 0] > 0.0).all()


@pytest.mark.parametrize('robot', [COMPACT, WIDE])
def test_stuck_wheel_carries_what_reaches_it_through_the_body(robot):
    run = push(Model(robot), 1.2 * STATIC, 0.2 * STATIC, 2.0)
    assert not run.wheel_speed[:, 1].any()
    net = run.traction[1:, 0] - run.friction[1:, 0]
    expected = 0.2 * STATIC + coupling(robot) * net
    np.testing.assert_allclose(run.friction[1:, 1], expected, rtol=1e-12)
    assert np.abs(expected - 0.2 * STATIC).max() > 0.1 * STATIC


def test_paper_is_right_where_inertia_is_mass_times_half_separation_squared():
    balanced = Robot(mass=8.0, inertia=0.5, wheel_separation=0.5)
    run = push(Model(balanced), 1.2 * STATIC, 0.2 * STATIC, 2.0)
    np.testing.assert_allclose(run.friction[1:, 1], 0.2 * STATIC, rtol=1e-12)


def test_unpowered_wheel_breaks_away_by_the_reaction_alone():
    """The paper's own test, |F_L| < F_s, would hold it for ever."""
    right = COULOMB - 3.0 * STATIC / coupling(COMPACT)
    run = push(Model(COMPACT), right, 0.0, 0.5)
    assert (run.wheel_speed[1:, 0] > 0.0).all()
    assert (run.wheel_speed[1:, 1] < 0.0).all()


@given(robot=robots(), law=st.sampled_from(MODELS[1:]), mu=st.floats(0.05, 0.3), start=starts())
def test_coasting_robot_stops_for_good(robot, law, mu, start):
    friction = Friction(law, 4.9 * robot.mass, mu_static=0.3, mu_coulomb=mu)
    run = push(Model(robot, friction), 0.0, 0.0, 30.0, start=start)
    (still,) = np.nonzero(~run.wheel_speed.any(axis=1))
    assert len(still)
    assert not run.wheel_speed[still[0] :].any()
    assert not run.friction[still[0] :].any()
    assert (run.pose[still[0] :] == run.pose[-1]).all()


@given(model=models(), rows=drives(1e6), start=starts())
@example(  # stages look far past speed 0, where the Stribeck curve must not explode
    model=Model(Robot(1.0, 0.015, 0.25), Friction('generalized', 1.0, 1.0, 0.0, 0.0, 100.0)),
    rows=[(0.0, -1e6, -1e6)],
    start=State(omega=-5.0),
)
def test_finite_input_gives_finite_output(model, rows, start):
    assert np.isfinite(table(drive(model, *rows, until=3.0, start=start))).all()


@pytest.mark.parametrize('viscous', [1e2, 1e3])
@pytest.mark.parametrize('stribeck', [25.0, 1e4])
def test_stiff_friction_is_followed_to_terminal_speed(viscous, stribeck):
    """Far beyond the step that an explicit method takes in its stride."""
    stiff = Friction(mu_viscous=viscous, stribeck=stribeck, mu_static=1.0)
    run = drive(Model(friction=stiff), (0.0, 200.0, 90.0), (1.0, -200.0, -90.0), until=2.0)
    for stamp, force in ((-22, 200.0), (-2, -200.0)):
        assert run.friction[stamp] == pytest.approx((force, 0.45 * force), rel=1e-6)


@pytest.mark.parametrize(('normal_force', 'left'), [(5e3, 1e-9), (1e5, 1.0), (1e6, 1.0)])
def test_friction_adds_no_energy_however_stiff_it_is(normal_force, left):
    """What no step is short enough for keeps its speed."""
    stiff = Model(friction=Friction(mu_viscous=1e3, normal_force=normal_force))
    speed = drive(stiff, (0.0, 0.0, 0.0), until=0.02, every=0.01, start=State(v=1.0)).twist[:, 0]
    assert np.all(np.diff(speed) <= 0.0)
    assert 0.0 <= speed[-1] <= left


def test_coulomb_with_stiction_breaks_at_static_and_slides_at_coulomb_friction():
    model = Model(friction=Friction(model='coulomb_stiction'))
    assert not push(model, 0.99 * STATIC, 0.99 * STATIC, 1.0).wheel_speed.any()
    run = push(model, 1.01 * STATIC, 1.01 * STATIC, 1.0)
    expected = 2.0 * (1.01 * STATIC - COULOMB) / model.robot.mass * run.time
    np.testing.assert_allclose(run.twist[:, 0], expected, rtol=1e-12)


@given(robot=robots(), excess=st.floats(1.001, 10.0))
def test_equal_forces_tear_both_wheels_loose_together(robot, excess):
    """Friction drops at breakaway, so one wheel alone could go and relieve the other."""
    run = push(Model(robot, Friction('coulomb_stiction')), excess * STATIC, excess * STATIC, 1.0)
    assert (run.wheel_speed[1:, 0] > 0.0).all()
    assert not run.twist[:, 1].any()


@given(inertia=st.floats(0.05, 0.3), share=st.floats(0.75, 0.85), step=st.floats(1e-4, 1e-2))
def test_wheel_that_can_rest_does_not_go_with_the_other(inertia, share, step):
    """Even where the breakaway is located so well that rounding hides whose it was."""
    model = Model(Robot(inertia=inertia), Friction('coulomb_stiction'), (ActuatorLag(0.1),))
    rows = (0.0, 0.0, 0.0), (0.1, share * STATIC, 1.1 * STATIC)
    run = drive(model, *rows, until=1.0, max_step=step)
    assert not run.wheel_speed[:, 0].any()
    assert run.wheel_speed[-1, 1] > 0.0


@given(force=numbers(1e-7, 1e3))
def test_without_friction_any_force_moves_the_robot(force):
    run = push(Model(friction=Friction(model='none')), force, force, 1.0)
    assert run.twist[-1, 0] == pytest.approx(2.0 * force / 10.0)
    assert not run.friction.any()


@given(right=forces(), left=forces())
def test_strong_reversal_passes_through_zero_without_sticking(right, left):
    """Position is smooth, and friction turns round with the wheel."""
    assume(min(abs(right), abs(left)) > 3.0 * STATIC)
    balanced = Model(Robot(mass=8.0, inertia=0.5, wheel_separation=0.5))
    run = drive(balanced, (0.0, right, left), (1.0, -right, -left), until=6.0)
    assert (run.wheel_speed[-1] * (right, left) < 0.0).all()
    assert (run.wheel_speed * run.friction >= 0.0).all()


@given(total=st.floats(5.0, 20.0), share=numbers(-0.99, 0.99))
def test_yaw_friction_keeps_a_pushed_robot_exactly_straight(total, share):
    half = share * 0.3 / SLOTTED.robot.wheel_separation
    run = push(SLOTTED, total + half, total - half, 5.0)
    assert (run.wheel_speed[:, 0] == run.wheel_speed[:, 1]).all()
    assert not run.pose[:, 1:].any()
    assert run.twist[-1, 0] > 0.1


@given(share=st.floats(1.01, 3.0), sign=st.sampled_from([1.0, -1.0]))
def test_yaw_friction_yields_above_its_limit(share, sign):
    half = sign * share * 0.3 / SLOTTED.robot.wheel_separation
    run = push(SLOTTED, 10.0 + half, 10.0 - half, 2.0)
    assert (sign * run.twist[1:, 1] > 0.0).all()


@pytest.mark.parametrize('sign', [1.0, -1.0])
def test_wheels_and_yaw_friction_hold_a_turning_force_together(sign):
    limit = sign * (STATIC + 0.3 / SLOTTED.robot.wheel_separation)
    assert not push(SLOTTED, 0.99 * limit, -0.99 * limit, 5.0).wheel_speed.any()
    assert push(SLOTTED, 1.01 * limit, -1.01 * limit, 1.0).twist[-1, 1] * sign > 0.0


def test_curve_straightens_exactly_once_yaw_friction_has_caught_it():
    run = push(SLOTTED, 10.0, 10.0, 4.0, start=State(v=1.0, omega=0.5))
    (straight,) = np.nonzero(run.twist[:, 1] == 0.0)
    assert 0 < straight[0] < 60
    assert not run.twist[straight[0] :, 1].any()
    assert (run.pose[straight[0] :, 2] == run.pose[-1, 2]).all()
