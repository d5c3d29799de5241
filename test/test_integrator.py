"""The integrator: closed forms, order, symmetries, energy, and a reference that is not ours."""

import numpy as np
import pytest
from accuracy import error, ours
from hypothesis import example, given
from hypothesis import strategies as st
from motion import (
    commands,
    drive,
    drives,
    forces,
    frictions,
    kinetic_energy,
    models,
    numbers,
    push,
    robots,
    starts,
    table,
    traction_work,
)
from stick_slip import COULOMB_VISCOUS, GENERALIZED, rolling, stick_slip

from diffbot_sim.physics import Friction, Model, Robot, simulate
from diffbot_sim.physics.effects.actuator_lag import ActuatorLag
from diffbot_sim.physics.effects.direction_dependent_friction import DirectionDependentFriction
from diffbot_sim.physics.effects.quadratic_drag import QuadraticDrag
from diffbot_sim.physics.effects.slope import Slope
from diffbot_sim.physics.effects.wheel_friction_asymmetry import WheelFrictionAsymmetry
from diffbot_sim.physics.effects.yaw_friction import YawFriction
from diffbot_sim.physics.state import State
from diffbot_sim.records import Array, Commands

NOMINAL = Model()
MASS, STATIC = NOMINAL.robot.mass, NOMINAL.friction.law().static
# J = m b²/4, so each wheel tears strongly at the other: from order 3.5 at 20 ms it nears 4.
COMPACT = Model(Robot(inertia=0.1))
COULOMB, VISCOUS = NOMINAL.friction.law().coulomb, NOMINAL.friction.law().viscous


def viscous_only(mu: float) -> Friction:
    return Friction('coulomb_viscous', mu_coulomb=0.0, mu_viscous=mu)


# Closed forms.


@given(robot=robots(), right=forces(), left=forces())
@example(robot=Robot(1.0, 0.054931640625, 0.46875), right=0.0, left=1e-7)  # B = 0
def test_without_friction_the_robot_obeys_equations_7_and_11(robot, right, left):
    run = push(Model(robot, Friction('none')), right, left, 2.0)
    v = (right + left) / robot.mass * run.time
    omega = (right - left) * robot.half_separation / robot.inertia * run.time
    tolerance = 1e-12 * (abs(right) + abs(left)) / robot.mass + 1e-300
    np.testing.assert_allclose(run.twist[:, 0], v, rtol=1e-12, atol=tolerance)
    tolerance /= robot.half_separation
    np.testing.assert_allclose(run.twist[:, 1], omega, rtol=1e-12, atol=20 * tolerance)


@given(speed=numbers(1e-7, 3.0), mu=st.floats(0.01, 0.5))
def test_coulomb_friction_stops_the_robot_after_m_v_squared_over_4_coulomb(speed, mu):
    friction = Friction('coulomb', mu_coulomb=mu)
    run = push(Model(friction=friction), 0.0, 0.0, 40.0, every=1.0, start=State(v=speed))
    distance = speed**2 * MASS / (2.0 * 2.0 * mu * friction.normal_force)
    assert run.pose[-1, 0] == pytest.approx(distance, rel=1e-7)
    assert not run.twist[-1].any()


def test_weaker_wheel_decides_the_turn_to_the_right_of_figure_12():
    run = drive(NOMINAL, (0.0, 5.0, 5.1), (3.0, 0.0, 0.0), until=10.0)
    assert run.pose[-1, 1] < 0.0
    assert run.pose[-1, 2] < 0.0


@given(rate=st.floats(0.1, 10.0))
def test_ramp_breaks_away_when_it_reaches_static_friction(rate):
    step = 1e-3 / rate
    stamps = np.arange(0.0, 1.2 * STATIC / rate, step)
    ramp = Commands(stamps, np.column_stack([rate * stamps] * 2))
    run = simulate(NOMINAL, ramp, stamps)
    (moving,) = np.nonzero(run.wheel_speed[:, 0])
    assert stamps[moving[0]] == pytest.approx(STATIC / rate, abs=2.1 * step)


@given(share=st.floats(0.1, 0.9), tau=st.floats(0.1, 2.0))
def test_breakaway_is_located_inside_the_step(share, tau):
    """Force F (1 - exp(-t/τ)) passes F_k = share F at t = -τ ln(1 - share)."""
    model = Model(friction=Friction('coulomb'), effects=(ActuatorLag(tau),))
    force, moment = COULOMB / share, -tau * np.log1p(-share)
    times, rows = np.array([-0.5, moment + 2.0]), ((-1.0, 0.0, 0.0), (0.0, force, force))
    speed = simulate(model, commands(*rows), times, max_step=0.02).twist[-1, 0]
    surplus = (force - COULOMB) * (2.0 - tau * (1.0 - np.exp(-2.0 / tau)))
    assert speed == pytest.approx(2.0 * surplus / MASS, rel=1e-6)


@given(speed=st.floats(0.01, 3.0), mu=st.floats(0.01, 0.5), step=st.floats(1e-3, 2e-2))
def test_coulomb_and_viscous_friction_stop_the_robot_at_one_place_whatever_the_step(
    speed, mu, step
):
    """Distance m/(2 F_v) (v - F_k/F_v ln(1 + F_v v/F_k)): v dv/dx = -2 (F_k + F_v v)/m."""
    friction = Friction('coulomb_viscous', mu_coulomb=mu)
    run = push(Model(friction=friction), 0.0, 0.0, 5.0, start=State(v=speed), max_step=step)
    coulomb = friction.law().coulomb
    distance = speed - coulomb / VISCOUS * np.log1p(VISCOUS * speed / coulomb)
    assert run.pose[-1, 0] == pytest.approx(MASS / (2.0 * VISCOUS) * distance, rel=1e-7)
    assert not run.twist[-1].any()


@given(v=numbers(-5.0, 5.0), omega=numbers(-5.0, 5.0), mu=st.floats(0.01, 1.0))
def test_viscous_friction_lets_speed_fall_exponentially(v, omega, mu):
    model = Model(friction=viscous_only(mu))
    run = push(model, 0.0, 0.0, 3.0, start=State(v=v, omega=omega), max_step=1e-3)
    damping, b = 2.0 * mu * 49.05, model.robot.half_separation
    expected_v = v * np.exp(-damping / MASS * run.time)
    expected_omega = omega * np.exp(-damping * b * b / model.robot.inertia * run.time)
    np.testing.assert_allclose(run.twist[:, 0], expected_v, rtol=1e-8, atol=1e-9)
    np.testing.assert_allclose(run.twist[:, 1], expected_omega, rtol=1e-8, atol=1e-9)


@given(force=st.floats(1.1 * STATIC, 50.0), sign=st.sampled_from([1.0, -1.0]))
def test_constant_traction_ends_at_terminal_speed(force, sign):
    model = Model(friction=Friction('coulomb_viscous'))
    run = push(model, sign * force, sign * force, 60.0, every=1.0)
    assert run.twist[-1, 0] == pytest.approx(sign * (force - COULOMB) / VISCOUS)
    np.testing.assert_allclose(run.friction[-1], run.traction[-1])


# Order and reference.


def error_norms(model: Model, rows: list[tuple[float, float, float]], start: State) -> Array:
    """Return errors at 4 s of steps 0.1, 0.05, 0.025 s against a far shorter one."""
    ends = [
        drive(model, *rows, until=4.0, every=1.0, start=start, max_step=step)
        for step in (0.1, 0.05, 0.025, 0.1 / 128)
    ]
    rows_at_end = [np.concatenate([run.pose[-1], run.twist[-1]]) for run in ends]
    return np.array([np.abs(row - rows_at_end[-1]).max() for row in rows_at_end[:-1]])


def test_order_is_four_on_smooth_drives():
    errors = error_norms(NOMINAL, [(0.0, 9.0, 7.0), (2.0, 6.0, 12.0)], State(v=0.3, omega=0.2))
    np.testing.assert_allclose(np.log2(errors[:-1] / errors[1:]), 4.0, atol=0.1)


@pytest.mark.parametrize('model', [GENERALIZED, COULOMB_VISCOUS, COMPACT])
def test_reference_drive_sticks_and_slips_with_either_wheel(model):
    course = stick_slip(model)
    right, left = course.rows[:, 3:].T == 0.0
    assert course.events > 30
    assert min((right & ~left).sum(), (left & ~right).sum(), (right & left).sum()) > 20


@pytest.mark.parametrize('model', [GENERALIZED, COULOMB_VISCOUS, COMPACT])
def test_stick_slip_at_10_ms_stays_within_10_micrometres_of_the_reference(model):
    assert error(ours, model, stick_slip(model), 0.01) < 10e-6


@pytest.mark.parametrize('model', [GENERALIZED, COULOMB_VISCOUS])
@pytest.mark.parametrize('course', [stick_slip, rolling])
def test_order_is_four_through_stick_slip_as_between_events(course, model):
    steps = 0.02, 0.01, 0.005
    errors = np.array([error(ours, model, course(model), step) for step in steps])
    np.testing.assert_allclose(np.log2(errors[:-1] / errors[1:]), 4.0, atol=0.4)


# Symmetries: exact, to the last bit.

SYMMETRIC = (QuadraticDrag(3.0), YawFriction(0.2, 0.1), ActuatorLag(0.05))
MIRRORED = [
    ((), ()),
    (SYMMETRIC, SYMMETRIC),
    ((DirectionDependentFriction(0.2, 0.1),), (DirectionDependentFriction(0.2, 0.1),)),
    ((WheelFrictionAsymmetry(0.2, 0.1),), (WheelFrictionAsymmetry(-0.2, -0.1),)),
    ((Slope(0.01, 0.02),), (Slope(0.01, -0.02),)),
]


@pytest.mark.parametrize(('effects', 'mirrored'), MIRRORED)
@given(model=models(), rows=drives())
def test_swapped_wheels_give_the_mirrored_motion(effects, mirrored, model, rows):
    run = drive(Model(model.robot, model.friction, effects), *rows, until=2.5)
    swapped = [(time, left, right) for time, right, left in rows]
    image = drive(Model(model.robot, model.friction, mirrored), *swapped, until=2.5)
    assert (image.pose == run.pose * (1.0, -1.0, -1.0)).all()
    assert (image.twist == run.twist * (1.0, -1.0)).all()
    assert (image.wheel_speed == run.wheel_speed[:, ::-1]).all()
    assert (image.friction == run.friction[:, ::-1]).all()


@given(model=models(SYMMETRIC), rows=drives())
def test_reversed_forces_give_the_motion_turned_round(model, rows):
    run = drive(model, *rows, until=2.5)
    back = drive(model, *[(time, -right, -left) for time, right, left in rows], until=2.5)
    assert (back.pose == run.pose * (-1.0, 1.0, -1.0)).all()
    assert (back.wheel_speed == -run.wheel_speed).all()
    assert (back.friction == -run.friction).all()


@given(model=models(), rows=drives(), start=starts())
def test_same_input_gives_the_same_bits(model, rows, start):
    first, second = (drive(model, *rows, until=2.5, start=start) for _ in range(2))
    assert table(first).tobytes() == table(second).tobytes()


@given(model=models(), rows=drives(10.0), later=st.floats(-1e3, 1e3))
def test_time_itself_changes_nothing(model, rows, later):
    """A later start rounds the stamps, no more."""
    first = drive(model, *rows, until=2.5)
    moved = commands(*[(time + later, right, left) for time, right, left in rows])
    second = simulate(model, moved, first.time + later)
    np.testing.assert_allclose(second.pose, first.pose, rtol=1e-6, atol=1e-6)


# Energy.


@given(model=models(), start=starts())
def test_coasting_robot_never_gains_energy(model, start):
    energy = kinetic_energy(model.robot, push(model, 0.0, 0.0, 3.0, start=start))
    assert (np.diff(energy) <= 1e-12 * energy[0]).all()


@given(robot=robots(), friction=frictions(), rows=drives(), start=starts())
def test_friction_never_adds_energy(robot, friction, rows, start):
    """Kinetic energy rises by no more than the work of traction."""
    run = drive(Model(robot, friction), *rows, until=2.5, every=0.25 / 8, start=start)
    energy, work = kinetic_energy(robot, run), traction_work(robot, run)
    taken = np.diff(work) - np.diff(energy)
    turnover = energy.max() + np.abs(np.diff(work)).sum()
    assert taken.min() >= -1e-6 * turnover - 1e-20
