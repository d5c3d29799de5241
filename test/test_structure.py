"""Structure that no effect accounts for, found in what a fit leaves."""

import re
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from bristles import driven_on_bristles
from fits import ROUGH, SMOOTH, acted_otherwise, fitted, left_by
from peer_drives import DRIVES
from peer_recording import Recording, record
from peer_robots import MAKES, declared, exact
from recovery_cases import Case
from recovery_judge import planted_in, recorded
from rehearsal import Surroundings, random_forces, rehearse
from smoothed import driven_smoothly

from diffbot_sim.identification import identify
from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.free_forms.dependence import (
    Dependence,
    against_the_model,
    realised,
)
from diffbot_sim.identification.free_forms.near_rest import eased
from diffbot_sim.identification.free_forms.structure import dependences, describe, find_dependences
from diffbot_sim.identification.free_forms.warmth import lately
from diffbot_sim.identification.free_forms.winding import wound
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.selection.screening import Screen
from diffbot_sim.identification.suspicion import SUSPICIOUS
from diffbot_sim.physics import Friction, Model, simulate
from diffbot_sim.physics.effects.actuator_gain import ActuatorGain
from diffbot_sim.physics.effects.direction_dependent_friction import DirectionDependentFriction
from diffbot_sim.physics.effects.effective_track import EffectiveTrack
from diffbot_sim.physics.effects.power_limit import PowerLimit
from diffbot_sim.physics.effects.transmission_loss import TransmissionLoss
from diffbot_sim.physics.effects.yaw_friction import YawFriction
from diffbot_sim.records import Commands, Run


def test_rough_floor_alone_leaves_nothing_to_be_told() -> None:
    drive = random_forces(4, 60.0, -9.0, 11.0)
    assert left_by(rehearse(Model(), drive, ROUGH, 4)) == []


def test_weak_force_in_proportion_to_something_is_told_as_a_line() -> None:
    uneven = Model().with_effect(ActuatorGain(imbalance=0.03))
    left, *_ = left_by(rehearse(uneven, random_forces(3, 60.0, -9.0, 11.0), ROUGH, 3))
    assert (left.basis.variable, left.basis.axis) == ('wheel_force', 'difference')
    assert left.basis.size == 2


@pytest.mark.parametrize('around', [SMOOTH, ROUGH], ids=['smooth', 'rough'])
def test_weak_motors_are_told_by_the_power_they_are_asked_for(around: Surroundings) -> None:
    weak = Model().with_effect(PowerLimit(power=4.0))
    left, *_ = left_by(rehearse(weak, random_forces(3, 60.0, -20.0, 20.0), around, 3))
    assert (left.basis.variable, left.basis.axis) == ('force_over_power', 'wheels')


@pytest.mark.parametrize('around', [SMOOTH, ROUGH], ids=['smooth', 'rough'])
def test_wheels_that_are_nearer_are_told_by_where_they_turn_back(around: Surroundings) -> None:
    nearer = Model().with_effect(EffectiveTrack(widening=-0.08))
    left, *_ = left_by(rehearse(nearer, random_forces(5, 60.0, -9.0, 11.0), around, 5))
    assert left.basis.variable == 'arcs'


def drive_on_wheels_that_creep(carpet: float = 0.0, seed: int = 4) -> tuple[Run, Model]:
    """Return a drive on wheels that creep at 5 mm/s below static friction, and its model."""
    make = MAKES['medium']
    plant = make.plant._replace(creep=0.005, carpet=carpet, carpet_time=45.0)
    how = Recording(v_noise=0.001, omega_noise=0.003)
    run = record(plant, DRIVES['forces'](make, seed, how.duration, how.rate), how, seed)
    return run, exact(make.plant)


def test_wheels_that_creep_below_static_friction_leave_nothing_to_be_told() -> None:
    run, declared = drive_on_wheels_that_creep()
    fit, held_out = fitted(run, declared)
    assert find_dependences(Screen(fit), held_out) != []
    result = identify([run], declared, kinds=[])
    assert result.verdict == 'nothing_missing'
    assert result.near_rest > SUSPICIOUS


def test_wheels_that_yield_like_bristles_leave_nothing_to_be_told() -> None:
    run = driven_on_bristles(Model(), random_forces(3, 60.0, -9.0, 11.0), 3)
    assert left_by(run) != []
    result = identify([run], Model(), kinds=[])
    assert result.verdict == 'nothing_missing'
    assert result.near_rest > SUSPICIOUS


def test_wheels_that_yield_are_allowed_for_however_hard_they_are_driven() -> None:
    run = driven_on_bristles(Model(), random_forces(3, 60.0, -40.0, 40.0), 3)
    allowing, _ = eased(*fitted(run))
    assert np.any(allowing.stretches[0].pushes)


def test_tyres_that_begin_to_scrub_smoothly_leave_nothing_beside_yaw_friction() -> None:
    model = Model(friction=Friction('coulomb_viscous'))
    run = driven_smoothly(model, random_forces(3, 60.0, -9.0, 11.0), 0.2, 3)
    result = identify([run], model, kinds=[YawFriction])
    assert [effect.name for effect in result.effects] == ['yaw_friction']
    assert result.unexplained is None


def test_name_that_explains_most_of_what_was_left_stands_beside_wheels_that_creep() -> None:
    case = Case('creeping', ('yaw_friction',), 'typical', 'large', 'rough', 23, creep=0.01)
    run = recorded(case, planted_in(case)[0])
    result = identify([run], declared(MAKES[case.make], case.seed), kinds=[YawFriction])
    assert [effect.name for effect in result.effects] == ['yaw_friction']
    assert result.unexplained is None


def test_what_wheels_that_creep_roll_on_is_told() -> None:
    # In this drive where the robot is does not tell when that is.
    fit, held_out = eased(*fitted(*drive_on_wheels_that_creep(carpet=0.3, seed=3)))
    left, *_ = find_dependences(Screen(fit), held_out)
    assert left.basis.variable == 'friction_over_time'


def test_force_that_is_always_there_is_told_to_depend_on_nothing() -> None:
    drive = random_forces(3, 60.0, -9.0, 11.0)
    left, *_ = left_by(acted_otherwise(drive, drive.force + 0.2, ROUGH))
    assert (left.basis.variable, left.basis.axis) == ('constant', 'v')


def test_force_that_is_gone_where_data_are_held_out_is_told_all_the_same() -> None:
    drive = random_forces(3, 60.0, -9.0, 11.0)
    bent = 0.03 * drive.force * np.abs(drive.force)
    fit, _ = fitted(acted_otherwise(drive, drive.force - bent, ROUGH))
    _, held_out = fitted(acted_otherwise(drive, drive.force + bent, ROUGH))
    found = find_dependences(Screen(fit), held_out)
    assert 'wheel_force' in {dependence.basis.variable for dependence in found}


def test_forces_in_steps_are_told_with_the_step() -> None:
    time = np.arange(0.0, 60.0, 0.02)
    waves = [np.sin(np.outer(time, rates)).sum(axis=1) for rates in ((0.7, 1.9), (0.9, 2.3))]
    smooth = Commands(time, 1.0 + 5.0 * np.column_stack(waves))
    left, *_ = left_by(acted_otherwise(smooth, 1.7 * np.round(smooth.force / 1.7)))
    assert left.basis.variable == 'force_steps'
    assert 1.0 / left.basis.grid[0] == pytest.approx(1.7, rel=0.01)


def test_force_that_changes_only_so_fast_is_told_by_its_changes() -> None:
    drive = random_forces(3, 60.0, -9.0, 11.0)
    force, most = drive.force.copy(), 30.0 * np.diff(drive.time)
    for k, change in enumerate(most, start=1):
        force[k] = force[k - 1] + np.clip(drive.force[k] - force[k - 1], -change, change)
    result = identify([acted_otherwise(drive, force)], Model())
    assert result.effects == ()
    assert result.unexplained is not None
    assert result.unexplained.variable == 'force_change'


def test_force_that_waits_where_it_turns_back_is_told_by_its_sign() -> None:
    time = np.arange(0.0, 60.0, 0.02)
    drive = Commands(time, 1.0 + 7.0 * np.sin(np.outer(time, (1.3, 1.7))))
    sense = np.sign(drive.force)
    waits = sense != np.vstack([sense[:1]] * 7 + [sense[:-7]])  # for 0.14 s
    force = np.where(waits, drive.force - 3.0 * sense, drive.force)
    left, *_ = left_by(acted_otherwise(drive, force))
    assert (left.basis.variable, left.basis.axis) == ('time_since_reversal', 'wheels')


def test_command_that_acts_on_the_other_wheel_too_is_told_by_it() -> None:
    drive = random_forces(3, 60.0, -9.0, 11.0)
    coupled = acted_otherwise(drive, drive.force @ [[1.0, 0.3], [0.0, 1.0]])
    result = identify([coupled], Model(), kinds=[ActuatorGain, YawFriction])
    assert result.effects == ()
    assert result.unexplained is not None
    assert result.unexplained.variable == 'other_force'


def test_friction_that_falls_as_a_wheel_warms_is_told_by_how_much_it_rolled_lately() -> None:
    drive = random_forces(3, 90.0, -9.0, 11.0)
    drive = replace(drive, force=drive.force * (drive.time % 30.0 < 15.0)[:, None])
    speeds = simulate(Model(), drive, drive.time).twist @ [[1.0, 1.0], [0.2, -0.2]]
    eased = 1.5 * np.sign(speeds) * lately(np.abs(speeds), drive.time, 10.0)
    left, *_ = left_by(acted_otherwise(drive, drive.force + eased))
    assert (left.basis.variable, left.basis.axis) == ('warmth', 'wheels')


def test_tyres_that_wind_up_are_told_by_how_far() -> None:
    drive = random_forces(3, 60.0, -9.0, 11.0)
    speeds = simulate(Model(), drive, drive.time).twist @ [[1.0, 1.0], [0.2, -0.2]]
    pulled = -0.4 * wound(drive.time, speeds, 0.1)
    left, *_ = left_by(acted_otherwise(drive, drive.force + pulled, ROUGH))
    assert (left.basis.variable, left.basis.axis) == ('winding', 'wheels')
    assert left.basis.grid[0] == 0.1


def test_gear_that_rubs_under_load_is_told_by_how_hard_it_is_driven() -> None:
    geared = Model().with_effect(TransmissionLoss(loss=0.15))
    left, *_ = left_by(rehearse(geared, random_forces(3, 60.0, -9.0, 11.0), SMOOTH, 3))
    assert (left.basis.variable, left.basis.axis) == ('drive', 'wheels')


def pushed_again_and_again(around: Surroundings) -> Run:
    """Return a minute in which something pushes for 0.4 s every 3.2 s."""
    drive = random_forces(3, 60.0, -9.0, 11.0)
    return acted_otherwise(drive, drive.force + 2.0 * (drive.time % 3.2 < 0.4)[:, None], around)


def test_push_that_comes_again_and_again_is_told_with_its_period() -> None:
    left, *_ = left_by(pushed_again_and_again(ROUGH))
    assert (left.basis.variable, left.basis.axis) == ('rhythm', 'v')
    assert 'every 3.2 s' in left.basis.words


def test_push_that_comes_again_and_again_is_no_bias() -> None:
    result = identify([pushed_again_and_again(SMOOTH)], Model())
    assert result.effects == ()
    assert result.unexplained is not None
    assert result.unexplained.variable == 'rhythm'


def test_drive_of_a_wheel_that_pulses_is_told_with_its_period() -> None:
    drive = random_forces(3, 60.0, -9.0, 11.0)
    pulsing = np.column_stack([1.0 + 0.6 * np.sin(2.0 * np.pi * 2.5 * drive.time), drive.time**0])
    result = identify([acted_otherwise(drive, drive.force * pulsing)], Model())
    assert result.effects == ()
    assert result.unexplained is not None
    assert result.unexplained.variable == 'gain_rhythm'
    assert 'every 0.4 s' in result.unexplained.description


def test_supply_that_is_switched_now_and_then_is_told_by_time_in_proportion_to_the_force() -> None:
    drive = random_forces(3, 90.0, -9.0, 11.0)
    moments = np.cumsum(np.random.default_rng(2).uniform(3.0, 20.0, 20))
    falls = 1.0 - 0.3 * (np.searchsorted(moments, drive.time) % 2)
    left, *_ = left_by(acted_otherwise(drive, drive.force * falls[:, None]))
    assert (left.basis.variable, left.basis.axis) == ('force_over_time', 'wheels')


def test_wheels_that_stick_the_more_the_longer_they_rest_are_told_by_their_rest() -> None:
    rests = np.random.default_rng(1).uniform(0.2, 6.0, 24)
    starts = np.cumsum(rests + 3.0) - 3.0
    time = np.arange(0.0, starts[-1] + 3.0, 0.02)
    last = np.searchsorted(starts, time, side='right') - 1
    since = np.where(last >= 0, time - starts[last], np.inf)
    ramp = np.where(since < 2.0, np.minimum(6.0 * since, 5.0), 0.0)
    held = ramp < 2.4 + 0.8 * np.log(rests[last] / 2.0)
    both = np.repeat(np.column_stack([ramp, np.where(held, 0.0, ramp)])[:, None], 2, axis=1)
    left, *_ = left_by(acted_otherwise(Commands(time, both[..., 0]), both[..., 1]))
    assert left.basis.variable == 'rest_before'


def fitted_to_peer(**attached: float) -> tuple[Fit, Sequence[Stretch]]:
    """Return a plain fit, and held-out data, of a robot of other make that has something more."""
    make = MAKES['medium']
    driver = DRIVES['forces'](make, 3, 120.0, 50.0)
    run = record(make.plant._replace(**attached), driver, Recording(), 3)
    return fitted(run, exact(make.plant))


def left_by_peer(**attached: float) -> Dependence:
    """Return what a plain fit leaves of such a robot."""
    fit, held_out = fitted_to_peer(**attached)
    left, *_ = find_dependences(Screen(fit), held_out)
    return left


def test_load_that_swings_is_told_by_how_often() -> None:
    left = left_by_peer(mass=8.5, swing_mass=1.5, swing_rate=1.1, swing_damping=0.05)
    assert left.basis.variable == 'swing'
    assert left.basis.grid == pytest.approx([1.1], rel=0.2)


@pytest.mark.parametrize('rubs', [{'caster_swivel': 0.03}, {'caster_roll': 0.8}])
def test_caster_is_told_by_where_it_would_have_swivelled_to(rubs: dict[str, float]) -> None:
    left = left_by_peer(caster_ahead=-0.3, caster_trail=0.04, **rubs)
    assert left.basis.variable == 'caster'


def test_friction_that_differs_backward_is_told_as_a_push_one_way() -> None:
    worn = Model().with_effect(DirectionDependentFriction(dry=-0.3))
    left, *_ = left_by(rehearse(worn, random_forces(3, 60.0, -11.0, 11.0), SMOOTH, 3))
    assert (left.basis.variable, left.basis.axis) == ('rolling_one_way', 'wheels')


def test_wheel_that_rubs_at_a_place_of_its_turn_is_told_by_its_angle() -> None:
    fit, held_out = fitted_to_peer(tight=1.0, tight_right=1.0, tight_left=2.0)
    left, *_ = find_dependences(Screen(fit), held_out)
    assert left.basis.variable == 'friction_over_wheel_angle'
    assert left.basis.grid[0] == pytest.approx(1.0, rel=0.01)
    told, strengths = describe(left, fit), left.basis.strengths(left.amounts)
    assert re.search('N on the right wheel, .* N on the left wheel', told.description)
    assert strengths[told.part] == max(strengths.values())


@pytest.mark.parametrize('name', ['v', 'wheel_speed'])
def test_better_fit_that_the_model_finds_alone_is_no_merit_of_a_form(name: str) -> None:
    run = rehearse(Model(), random_forces(4, 60.0, -9.0, 11.0), SMOOTH, 4)
    best, _ = fitted(run)
    poor = replace(best, u=best.u + 0.02)
    like = next(d for d in dependences(Screen(poor)) if d.basis.variable == name)
    lucky = realised(poor, like)
    assert lucky.fall > 100.0
    assert against_the_model(poor, lucky).fall < 0.1 * lucky.fall
