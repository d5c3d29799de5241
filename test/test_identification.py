"""Identification of robots like our own, whose truth is known."""

from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest
from peer_robots import MAKES, declared
from recovery_cases import Case
from recovery_judge import planted_in, recorded
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.errors import DataError
from diffbot_sim.identification import identify
from diffbot_sim.identification.result import Identification
from diffbot_sim.physics import Friction, Model, Robot
from diffbot_sim.physics.effects import library, sought_effects
from diffbot_sim.physics.effects.actuator_fade import ActuatorFade
from diffbot_sim.physics.effects.empirical_wheel_force import EmpiricalWheelForce
from diffbot_sim.physics.effects.power_limit import PowerLimit
from diffbot_sim.physics.effects.quadratic_drag import QuadraticDrag
from diffbot_sim.physics.effects.slope import Slope
from diffbot_sim.physics.effects.voltage_limit import VoltageLimit
from diffbot_sim.records import Commands, Odometry, Run

DECLARED = Model(
    Robot(mass=11.0, inertia=0.35), Friction(mu_coulomb=0.035, mu_static=0.045, mu_viscous=0.07)
)
SMOOTH, ROUGH = Surroundings(), Surroundings(roughness=0.3)

# Effects that are searched for in different ways. benchmarks/recovery.py tries them all.
EXAMPLES = (
    'actuator_delay',
    'wheel_ripple',
    'friction_drift',
    'slope',
    'quadratic_drag',
    'payload_change',
    'power_limit',
    'voltage_limit',
    'effective_track',
)
RIPPLE = ('order', 'right_cos', 'right_sin', 'left_cos', 'left_sin')
# Where three scales from neutral are no size that anyone would meet.
AMPLE = {
    'actuator_saturation': {'limit': 7.0},
    'power_limit': {'power': 6.0},
    'voltage_limit': {'stall_force': 11.0, 'no_load_speed': 1.2},
    'payload_change': {'mass': 2.0, 'inertia': 0.08, 'moment': 23.4},
    'wheel_ripple': dict(zip(RIPPLE, (5.3, 0.5, 0.0, 0.2, 0.4), strict=True)),
}


def run_of(model: Model, seed: int, around: Surroundings = SMOOTH) -> Run:
    return rehearse(model, random_forces(seed, 60.0, -9.0, 11.0), around, seed)


def with_typical(name: str) -> Model:
    """Return the true robot with an effect of ample size."""
    kind = library()[name]
    values = {s.name: s.default + 3.0 * s.scale for s in kind.specs()}
    return Model().with_effect(kind(**(values | AMPLE.get(name, {}))))


@cache
def answer(name: str) -> Identification:
    return identify([run_of(with_typical(name), 3)], DECLARED)


@cache
def complete(around: Surroundings) -> Identification:
    return identify([run_of(Model(), 1, around)], DECLARED)


@pytest.mark.parametrize('around', [SMOOTH, ROUGH], ids=['smooth', 'rough'])
def test_robot_that_is_only_miscalibrated_lacks_nothing(around: Surroundings) -> None:
    result = complete(around)
    assert (result.verdict, result.effects, result.unexplained) == ('nothing_missing', (), None)


def test_robot_that_never_turns_lacks_nothing() -> None:
    both = random_forces(1, 60.0, -9.0, 11.0)
    straight = Commands(both.time, both.force.mean(axis=1, keepdims=True).repeat(2, axis=1))
    run = rehearse(Model(), straight, Surroundings(omega_noise=0.0), 1)
    assert not run.odometry.twist[:, 1].any()
    assert identify([run], DECLARED).verdict == 'nothing_missing'


def test_force_of_a_rough_floor_is_seen_where_nothing_is_missing() -> None:
    force = complete(ROUGH).comparisons[0].disturbance[:, 0]
    assert 0.1 < force.std() < 0.6  # two wheels with 0.3 N each, smoothed by the estimate


def test_errors_are_told_by_horizon_and_one_run_has_none_to_agree_with() -> None:
    result = complete(ROUGH)
    assert [item.name for item in result.horizons] == ['one step', '1 s', '5 s', 'free-running']
    assert result.runs == ()


@pytest.mark.parametrize('name', EXAMPLES)
def test_hidden_effect_is_named_alone(name: str) -> None:
    result = answer(name)
    assert [effect.name for effect in result.effects] == [name]
    assert result.verdict == 'effects_found'


@pytest.mark.parametrize('name', EXAMPLES)
def test_error_with_the_effect_falls_to_the_noise_floor(name: str) -> None:
    errors = answer(name).errors
    assert errors.with_effects.v_rmse < 1.05 * errors.noise_floor.v_rmse
    assert errors.with_effects.omega_rmse < 1.05 * errors.noise_floor.omega_rmse


def test_hidden_effect_is_named_on_a_rough_floor() -> None:
    result = identify([run_of(with_typical('slope'), 4, ROUGH)], DECLARED)
    assert [effect.name for effect in result.effects] == ['slope']


def test_fade_does_not_steepen_with_the_pushes_of_a_rough_floor() -> None:
    case = Case('single', ('actuator_fade',), 'typical', 'small', 'rough', 4)
    run = recorded(case, planted_in(case)[0])
    result = identify([run], declared(MAKES[case.make], case.seed), kinds=[ActuatorFade])
    assert [effect.name for effect in result.effects] == ['actuator_fade']


def test_two_effects_hidden_in_one_run_are_both_named() -> None:
    truth = with_typical('actuator_lag').with_effect(QuadraticDrag(4.0))
    result = identify([run_of(truth, 5)], DECLARED)
    assert {effect.name for effect in result.effects} == {'actuator_lag', 'quadratic_drag'}


def test_effect_that_the_library_lacks_is_unexplained_and_its_variable_named() -> None:
    others = [kind for name, kind in sought_effects().items() if name != 'slope']
    result = identify([run_of(with_typical('slope'), 6)], DECLARED, kinds=others)
    assert result.verdict == 'unexplained'
    assert result.unexplained is not None
    assert (result.unexplained.axis, result.unexplained.variable) == ('v', 'heading')


def test_effect_that_only_resembles_what_acts_is_not_named() -> None:
    others = [kind for name, kind in sought_effects().items() if name != 'actuator_delay']
    result = identify([run_of(with_typical('actuator_delay'), 3)], DECLARED, kinds=others)
    assert result.effects == ()
    assert result.unexplained is not None
    assert result.unexplained.variable == 'past_force'


def test_limit_that_does_not_fall_with_speed_is_not_named_for_what_makes_it_fall() -> None:
    falling = [PowerLimit, VoltageLimit]
    result = identify([run_of(with_typical('actuator_saturation'), 3)], DECLARED, kinds=falling)
    assert result.verdict == 'unexplained'


def test_interval_of_a_time_constant_longer_than_the_drive_reaches_far() -> None:
    found = answer('friction_drift').effects[0].parameters['time_constant']
    assert found.low < 150.0 < 1.3 * found.value < found.high


def with_another_friction(model: Model, largest: float) -> Model:
    """Return a robot whose friction differs by up to so much [N], alike forward and backward."""
    force = largest * np.array([1.0, 0.3, 0.0, -0.2, 0.0, 0.4])  # against the motion, by speed
    points = np.concatenate([force[::-1], -force])
    return model.with_effect(
        EmpiricalWheelForce('wheels', 'wheel_speed', -2.5, 2.5, *points.tolist())
    )


def test_friction_of_another_form_than_declared_is_told_as_such() -> None:
    result = identify([run_of(with_another_friction(DECLARED, 0.3), 5)], DECLARED)
    assert result.verdict == 'unexplained'
    assert result.unexplained is not None
    assert result.unexplained.variable == 'rolling'


@cache
def answer_on_another_friction() -> Identification:
    truth = with_another_friction(with_typical('friction_drift'), 0.3)
    return identify([run_of(truth, 3)], DECLARED)


def test_friction_of_another_form_than_declared_takes_no_name_away() -> None:
    result = answer_on_another_friction()
    assert [effect.name for effect in result.effects] == ['friction_drift']
    assert result.unexplained is not None
    assert result.unexplained.variable == 'rolling'


def test_numbers_told_beside_a_table_of_what_is_left_are_those_of_the_model() -> None:
    result = answer_on_another_friction()
    (told,) = result.effects
    table, drift = result.identified.effects
    assert table == result.empirical
    for name, estimate in told.parameters.items():
        assert estimate.value == pytest.approx(getattr(drift, name))


def test_effect_is_named_beside_a_larger_one_that_the_library_lacks() -> None:
    others = [kind for name, kind in sought_effects().items() if name != 'wheel_ripple']
    (small,) = with_typical('slope').effects
    result = identify(
        [run_of(with_typical('wheel_ripple').with_effect(small), 7)], DECLARED, kinds=others
    )
    assert [effect.name for effect in result.effects] == ['slope']
    assert result.unexplained is not None
    assert result.unexplained.variable == 'wheel_angle'


def test_interval_is_narrow_and_near_the_truth() -> None:
    estimate = answer('quadratic_drag').effects[0].parameters['coefficient']
    assert estimate.low < estimate.value < estimate.high
    assert estimate.value == pytest.approx(6.0, rel=0.02)
    assert estimate.high - estimate.low < 0.1


def test_interval_of_a_moment_holds_the_truth() -> None:
    estimate = answer('payload_change').effects[0].parameters['moment']
    assert estimate.low < AMPLE['payload_change']['moment'] < estimate.high
    assert estimate.high - estimate.low < 1.0


def test_effect_that_is_declared_is_not_missing() -> None:
    declared = DECLARED.with_effect(QuadraticDrag(3.0))
    result = identify([run_of(Model().with_effect(QuadraticDrag(3.0)), 7)], declared)
    assert result.verdict == 'nothing_missing'
    assert result.identified.effects == declared.effects


def test_same_runs_give_the_same_answer() -> None:
    runs = [run_of(with_typical('slope'), 3)]
    first, again = (identify(runs, DECLARED, kinds=[Slope, QuadraticDrag]) for _ in range(2))
    assert again.effects == first.effects != ()


def test_run_in_which_nothing_moves_is_refused() -> None:
    time = np.arange(0.0, 20.0, 0.02)
    still = Odometry(time, np.zeros((len(time), 2)), None)
    with pytest.raises(DataError, match='never moves'):
        identify([Run('parked', Commands(time, np.zeros((len(time), 2))), still)], DECLARED)


def test_run_without_pose_is_identified_too() -> None:
    run = run_of(with_typical('quadratic_drag'), 8)
    bare = Run(run.name, run.commands, Odometry(run.odometry.time, run.odometry.twist))
    assert [e.name for e in identify([bare], DECLARED).effects] == ['quadratic_drag']


@dataclass(frozen=True)
class OwnDrag(QuadraticDrag):
    """A law that no library holds."""

    name = 'own_drag'


def test_effect_that_no_library_holds_can_be_asked_for():
    run = run_of(with_typical('quadratic_drag'), 3)
    assert [it.name for it in identify([run], DECLARED, kinds=[OwnDrag]).effects] == ['own_drag']


def test_nothing_to_learn_from_is_refused():
    with pytest.raises(DataError, match='no run was given to learn from'):
        identify([], DECLARED)
