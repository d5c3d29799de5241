"""Errors over horizons: simulation restarted on held-out data."""

from dataclasses import replace

import numpy as np
import pytest
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.identification.conclusions.comparison import compare_models, errors_of
from diffbot_sim.identification.conclusions.horizons import _ends, horizons, state_at
from diffbot_sim.identification.fitting.coordinates import Space
from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.recordings.stretches import Stretch, split
from diffbot_sim.identification.result import Horizon
from diffbot_sim.physics import Model, Robot
from diffbot_sim.physics.effects import library
from diffbot_sim.records import Odometry, Run

NOISE = Surroundings()
GAINS = np.array([0.1, 0.01, 0.1, 0.1, 0.01, 0.1])
HEAVY = Model(Robot(mass=13.0))


def held_out(model: Model, seconds: float = 60.0) -> tuple[Stretch, ...]:
    return split([rehearse(model, random_forces(1, seconds, -9.0, 11.0), NOISE, 1)])[1]


def knowing(model: Model, stretches: tuple[Stretch, ...]) -> Fit:
    """Return a fit that knows the truth."""
    space = Space(model, ())
    return Fit(space, stretches, space.prior(), GAINS, np.array([0.004, 0.008]))


def judged(truth: Model, declared: Model, seconds: float = 60.0) -> dict[str, Horizon]:
    """Return the errors of a declared and of the true model by the name of the horizon."""
    stretches = held_out(truth, seconds)
    final = knowing(truth, stretches)
    errors = errors_of(compare_models(declared, truth, final, stretches), 'held_out')
    models = (declared, truth, final.model)
    return {item.name: item for item in horizons(models, final, stretches, errors)}


def with_typical(name: str) -> Model:
    kind = library()[name]
    return Model().with_effect(kind(**{s.name: s.default + 3.0 * s.scale for s in kind.specs()}))


@pytest.mark.parametrize('name', ['', 'actuator_lag', 'slope'])
def test_true_model_stays_at_the_noise_however_far_ahead(name: str) -> None:
    truth = with_typical(name) if name else Model()
    for item in judged(truth, truth).values():
        assert item.with_effects.v_rmse < 1.25 * NOISE.v_noise
        assert item.with_effects.omega_rmse < 1.25 * NOISE.omega_noise


def test_error_of_a_wrong_model_grows_with_the_horizon() -> None:
    found = judged(Model(), HEAVY)
    assert list(found) == ['one step', '1 s', '5 s', 'free-running']
    step, one, five, _ = (item.declared.v_rmse for item in found.values())
    assert step < one < five


def test_free_running_error_is_the_one_of_before_and_after() -> None:
    stretches = held_out(Model())
    final = knowing(Model(), stretches)
    errors = errors_of(compare_models(HEAVY, HEAVY, final, stretches), 'held_out')
    free = horizons((HEAVY, HEAVY, final.model), final, stretches, errors)[-1]
    assert (free.seconds, free.declared, free.with_effects) == (
        None,
        errors.declared,
        errors.with_effects,
    )


def test_horizon_longer_than_the_data_is_left_out() -> None:
    assert list(judged(Model(), HEAVY, 16.0)) == ['one step', '1 s', 'free-running']


def test_restart_is_where_the_robot_was_measured_and_as_fast_as_was_estimated() -> None:
    run = rehearse(Model(), random_forces(2, 20.0, -9.0, 11.0), Surroundings(0.0, 0.0), 2)
    (late,) = split([run])[1]
    state, moment = state_at(late, np.full((len(late.time), 2), 0.25), 50), late.time[50]
    pose = run.odometry.pose
    assert pose is not None
    row = np.searchsorted(run.odometry.time, moment)
    assert (state.x, state.y, state.heading) == pytest.approx(tuple(pose[row]))
    assert (state.v, state.omega) == (0.25, 0.25)
    assert state.turned == pytest.approx(pose[row, 2], abs=0.01)


def test_runs_of_any_number_are_restarted_at_most_300_times() -> None:
    run = rehearse(Model(), random_forces(3, 60.0, -9.0, 11.0), NOISE, 3)
    runs: list[Run] = [replace(run, name=str(i)) for i in range(5)]
    stretches = split(runs)[1]
    final = knowing(Model(), stretches)
    errors = errors_of(compare_models(HEAVY, HEAVY, final, stretches), 'held_out')
    one = horizons((HEAVY, HEAVY, final.model), final, stretches, errors)[1]
    assert 200 < one.count <= 300


def test_horizon_that_ends_in_a_hole_of_the_odometry_is_left_out() -> None:
    run = rehearse(Model(), random_forces(1, 60.0, -9.0, 11.0), NOISE, 1)
    kept = (run.odometry.time < 50.0) | (run.odometry.time > 53.0)
    odometry = Odometry(run.odometry.time[kept], run.odometry.twist[kept])
    (stretch,) = split([replace(run, odometry=odometry)])[1]
    told, ends = _ends(stretch, int(np.searchsorted(stretch.time, 49.5)))
    assert told.tolist() == [False, True]
    assert stretch.time[ends] == pytest.approx([54.5])
