"""Effects: what every one promises, found by walking the library, and each one's own physics."""

from dataclasses import dataclass, fields
from math import isfinite

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from motion import (
    commands,
    drive,
    drives,
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

from diffbot_sim.parameters import parameter
from diffbot_sim.physics import Friction, Model, effects, simulate
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.effects import Effect, library
from diffbot_sim.physics.effects.actuator_lag import ActuatorLag
from diffbot_sim.physics.effects.com_offset import ComOffset
from diffbot_sim.physics.effects.direction_dependent_friction import DirectionDependentFriction
from diffbot_sim.physics.effects.quadratic_drag import QuadraticDrag
from diffbot_sim.physics.effects.slope import STANDARD_GRAVITY, Slope
from diffbot_sim.physics.effects.wheel_friction_asymmetry import WheelFrictionAsymmetry
from diffbot_sim.physics.effects.yaw_friction import YawFriction
from diffbot_sim.physics.stages import Load, Motion, Stage, pushed
from diffbot_sim.physics.state import State

KINDS = list(library().values())
SMOOTH = Friction('none')
each_effect = pytest.mark.parametrize('kind', KINDS, ids=lambda kind: kind.name)


def within_reach(kind: type[Effect]) -> st.SearchStrategy[Effect]:
    """Draw parameters within their bounds, at most ten typical departures from neutral."""
    ranges = {
        spec.name: numbers(
            max(spec.low, spec.default - 10.0 * spec.scale),
            min(spec.high, spec.default + 10.0 * spec.scale),
        )
        for spec in kind.specs()
    }
    return st.builds(kind, **ranges)


# What every effect promises.


@each_effect
def test_effect_tells_people_what_it_is(kind):
    for words in (kind.name, kind.meaning, kind.source, kind.excitation):
        assert words.strip()
    assert kind.name.isidentifier()
    assert kind.__doc__


@each_effect
def test_every_field_of_an_effect_is_a_bounded_parameter(kind):
    names = [spec.name for spec in kind.specs()]
    assert names == [field.name for field in fields(kind)]
    for spec in kind.specs():
        assert spec.unit
        assert spec.meaning
        assert isfinite(spec.low)
        assert isfinite(spec.high)
        assert 0.0 < spec.scale <= spec.high - spec.low
        assert spec.fault(spec.default) is None


@each_effect
def test_fits_start_within_bounds_and_away_from_neutral(kind):
    assert kind.guesses
    for guess in kind.guesses:
        assert any(guess)
        for spec, departure in zip(kind.specs(), guess, strict=True):
            assert spec.fault(spec.default + departure) is None


@each_effect
@given(model=models(), rows=drives(20.0), start=starts())
def test_neutral_effect_changes_no_bit(kind, model, rows, start):
    without = drive(model, *rows, until=2.5, start=start)
    neutral = drive(model.with_effect(kind()), *rows, until=2.5, start=start)
    np.testing.assert_array_equal(table(neutral), table(without))


@given(model=models(), rows=drives(20.0), start=starts())
def test_all_effects_together_change_no_bit_when_neutral(model, rows, start):
    without = drive(model, *rows, until=2.5, start=start)
    everything = Model(model.robot, model.friction, tuple(kind() for kind in KINDS))
    neutral = drive(everything, *rows, until=2.5, start=start)
    np.testing.assert_array_equal(table(neutral), table(without))


@each_effect
@given(data=st.data(), rows=drives(20.0), start=starts())
def test_effect_gives_finite_output(kind, data, rows, start):
    model = Model(effects=(data.draw(within_reach(kind)),))
    assert np.isfinite(table(drive(model, *rows, until=2.5, start=start))).all()


@pytest.mark.parametrize('kind', [kind for kind in KINDS if kind.dissipative])
@given(data=st.data(), robot=robots(), rows=drives(20.0), start=starts())
def test_dissipative_effect_never_adds_energy(kind, data, robot, rows, start):
    model = Model(robot, SMOOTH, (data.draw(within_reach(kind)),))
    run = drive(model, *rows, until=2.5, every=0.25 / 8, start=start)
    energy, work = kinetic_energy(robot, run), traction_work(robot, run)
    turnover = energy.max() + np.abs(np.diff(work)).sum()
    assert (np.diff(work) - np.diff(energy)).min() >= -1e-5 * turnover


@each_effect
@given(guess=st.integers(0, 9), rows=drives(20.0))
def test_stamps_change_the_motion_by_no_more_than_the_integration_error(kind, guess, rows):
    """Stamps cut steps; they do nothing else."""
    departure = kind.guesses[guess % len(kind.guesses)]
    values = {s.name: s.default + d for s, d in zip(kind.specs(), departure, strict=True)}
    model = Model(effects=(kind(**values),))
    coarse = drive(model, *rows, until=2.5, every=0.25)
    fine = drive(model, *rows, until=2.5, every=0.25 / 64)
    np.testing.assert_allclose(fine.pose[::64], coarse.pose, rtol=1e-5, atol=1e-6)


def test_library_lists_effects_in_order_of_evaluation():
    places = [(kind.stage, kind.name) for kind in KINDS]
    assert places == sorted(places)
    assert list(library()) == [kind.name for kind in KINDS]


@given(order=st.permutations([ActuatorLag(0.1), QuadraticDrag(2.0), Slope(0.01), ComOffset(0.1)]))
def test_order_in_which_effects_are_given_does_not_matter(order):
    assert Model(effects=tuple(order)) == Model(effects=tuple(reversed(order)))


@compiled
def wind(at: Motion, load: Load, force: float) -> Load:
    """Push forward."""
    return pushed(load, force, 0.0)


@dataclass(frozen=True)
class Tailwind(Effect):
    """Constant force from behind."""

    name = 'tailwind'
    meaning = 'wind from behind'
    source = 'a package of its own'
    stage = Stage.BODY_LOAD
    kernel = wind
    guesses = ((1.0,),)
    excitation = 'any'

    force: float = parameter(0.0, unit='N', low=0.0, high=10.0, meaning='force of the wind')


class TailwindEntry:
    """What a package that brings the effect declares."""

    @staticmethod
    def load() -> type[Effect]:
        return Tailwind


def test_another_package_can_bring_an_effect(monkeypatch):
    monkeypatch.setattr(effects, 'entry_points', lambda group: [TailwindEntry])
    found = library.__wrapped__()
    assert found['tailwind'] is Tailwind
    assert set(found) == {*library(), 'tailwind'}
    run = push(Model(friction=SMOOTH, effects=(Tailwind(5.0),)), 0.0, 0.0, 1.0)
    assert run.twist[-1, 0] == pytest.approx(5.0 / 10.0)


# Each effect's own physics.


@given(coefficient=st.floats(0.1, 10.0), speed=numbers(-5.0, 5.0))
def test_drag_slows_a_free_robot_along_a_hyperbola(coefficient, speed):
    model = Model(friction=SMOOTH, effects=(QuadraticDrag(coefficient),))
    run = push(model, 0.0, 0.0, 3.0, start=State(v=speed))
    expected = speed / (1.0 + coefficient * abs(speed) * run.time / model.robot.mass)
    np.testing.assert_allclose(run.twist[:, 0], expected, rtol=1e-7, atol=1e-12)


@given(grade_x=numbers(-0.1, 0.1), grade_y=numbers(-0.1, 0.1), heading=numbers(-7.0, 7.0))
def test_slope_pulls_along_the_heading(grade_x, grade_y, heading):
    model = Model(friction=SMOOTH, effects=(Slope(grade_x, grade_y),))
    run = push(model, 0.0, 0.0, 2.0, start=State(heading=heading))
    pull = -STANDARD_GRAVITY * (grade_x * np.cos(heading) + grade_y * np.sin(heading))
    np.testing.assert_allclose(run.twist[:, 0], pull * run.time, rtol=1e-9, atol=1e-12)
    assert not run.twist[:, 1].any()


@given(grade=numbers(-0.1, 0.1), omega=st.floats(0.5, 3.0))
def test_slope_is_fixed_in_the_world_while_the_robot_turns(grade, omega):
    model = Model(friction=SMOOTH, effects=(Slope(grade),))
    run = push(model, 0.0, 0.0, 3.0, start=State(omega=omega))
    expected = -STANDARD_GRAVITY * grade * np.sin(omega * run.time) / omega
    np.testing.assert_allclose(run.twist[:, 0], expected, atol=1e-8)


@given(share=st.floats(0.1, 1.9), sign=st.sampled_from([1.0, -1.0]))
def test_static_friction_holds_the_robot_on_a_slope_up_to_its_limit(share, sign):
    nominal = Model()
    limit = 2.0 * nominal.friction.law().static / (nominal.robot.mass * STANDARD_GRAVITY)
    run = push(nominal.with_effect(Slope(sign * share * limit)), 0.0, 0.0, 5.0)
    moved = -sign * run.pose[-1, 0]
    assert moved == 0.0 if share < 0.999 else moved >= 0.0
    assert moved > 0.0 or share < 1.001


@given(tau=st.floats(0.01, 1.0), right=numbers(-20.0, 20.0), left=numbers(-20.0, 20.0))
def test_lagging_force_approaches_the_command_exponentially(tau, right, left):
    times = np.linspace(-0.1, 1.0, 56)
    rows = commands((-1.0, 0.0, 0.0), (0.0, right, left))
    run = simulate(Model(effects=(ActuatorLag(tau),)), rows, times)
    rise = np.where(times > 0.0, 1.0 - np.exp(-np.maximum(times, 0.0) / tau), 0.0)
    np.testing.assert_allclose(run.traction, np.outer(rise, (right, left)), atol=1e-10)


@given(offset=st.floats(-0.3, 0.3), v=numbers(-2.0, 2.0), omega=numbers(-5.0, 5.0))
def test_com_offset_alone_conserves_energy(offset, v, omega):
    model = Model(friction=SMOOTH, effects=(ComOffset(offset),))
    run = push(model, 0.0, 0.0, 5.0, start=State(v=v, omega=omega), max_step=1e-3)
    sideways = 0.5 * model.robot.mass * (offset * run.twist[:, 1]) ** 2
    energy = kinetic_energy(model.robot, run) + sideways
    np.testing.assert_allclose(energy, energy[0], rtol=1e-8, atol=1e-12)


@given(offset=st.floats(-0.3, 0.3), heading=numbers(-3.0, 3.0), omega=numbers(-2.0, 2.0))
def test_robot_with_com_offset_swings_on_a_slope_without_losing_energy(offset, heading, omega):
    grade_x, grade_y = 0.05, -0.03
    model = Model(friction=SMOOTH, effects=(ComOffset(offset), Slope(grade_x, grade_y)))
    start = State(heading=heading, v=0.5, omega=omega)
    run = push(model, 0.0, 0.0, 5.0, start=start, max_step=1e-3)
    x, y, angle = run.pose.T
    height = grade_x * (x + offset * np.cos(angle)) + grade_y * (y + offset * np.sin(angle))
    potential = model.robot.mass * STANDARD_GRAVITY * height
    sideways = 0.5 * model.robot.mass * (offset * run.twist[:, 1]) ** 2
    energy = kinetic_energy(model.robot, run) + sideways + potential
    np.testing.assert_allclose(energy, energy[0], atol=1e-6)


@pytest.mark.parametrize('effect', [{'dry': 0.2}, {'viscous': 0.2}])
@pytest.mark.parametrize('sign', [1.0, -1.0])
def test_robot_veers_to_the_side_that_rubs_more(effect, sign):
    """Positive asymmetry burdens the right wheel, and a right turn has ω < 0."""
    asymmetry = WheelFrictionAsymmetry(**{name: sign * x for name, x in effect.items()})
    run = push(Model(effects=(asymmetry,)), 5.0, 5.0, 5.0)
    assert (sign * run.twist[5:, 1] < 0.0).all()


@given(dry=st.floats(-0.5, 0.5), viscous=st.floats(-0.5, 0.5))
def test_direction_dependent_friction_sets_two_terminal_speeds(dry, viscous):
    friction = Friction('coulomb_viscous')
    law = friction.law()
    effect = DirectionDependentFriction(dry, viscous)
    model = Model(friction=friction, effects=(effect,))
    for way in (1.0, -1.0):
        run = push(model, way * 8.0, way * 8.0, 60.0, every=1.0, max_step=0.02)
        coulomb, damping = law.coulomb * (1 + way * dry), law.viscous * (1 + way * viscous)
        assert run.twist[-1, 0] == pytest.approx(way * (8.0 - coulomb) / damping, rel=1e-6)


@given(dry=st.floats(0.01, 2.0), omega=numbers(-5.0, 5.0))
def test_dry_yaw_friction_stops_a_spin_after_j_omega_squared_over_2_torque(dry, omega):
    model = Model(friction=SMOOTH, effects=(YawFriction(dry),))
    inertia, late = model.robot.inertia, model.robot.inertia * 5.0 / dry + 0.1
    run = push(model, 0.0, 0.0, late, every=late, start=State(omega=omega), max_step=0.1)
    turned = np.sign(omega) * inertia * omega**2 / (2.0 * dry)
    assert run.pose[-1, 2] == pytest.approx(turned, rel=1e-9)
    assert not run.twist[-1].any()


@given(viscous=st.floats(0.01, 2.0), omega=numbers(-5.0, 5.0))
def test_viscous_yaw_friction_lets_a_spin_fall_exponentially(viscous, omega):
    model = Model(friction=SMOOTH, effects=(YawFriction(viscous=viscous),))
    run = push(model, 0.0, 0.0, 2.0, start=State(omega=omega))
    expected = omega * np.exp(-viscous / model.robot.inertia * run.time)
    np.testing.assert_allclose(run.twist[:, 1], expected, rtol=1e-7, atol=1e-12)


@given(friction=frictions(), dry=numbers(0.0, 2.0), v=numbers(-2.0, 2.0))
def test_yaw_friction_does_not_touch_a_straight_drive(friction, dry, v):
    plain, start = Model(friction=friction), State(v=v)
    scrubbed = plain.with_effect(YawFriction(dry, 0.3))
    run, image = (push(model, 4.0, 4.0, 2.0, start=start) for model in (plain, scrubbed))
    np.testing.assert_allclose(image.twist, run.twist, rtol=1e-12, atol=1e-12)
