"""What free-form forces depend on, and how they push the body."""

from dataclasses import replace
from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.identification.fitting.coordinates import Space
from diffbot_sim.identification.fitting.fit import FIRST_GAINS, Fit, predictions
from diffbot_sim.identification.fitting.views import View
from diffbot_sim.identification.free_forms.bases import Basis
from diffbot_sim.identification.free_forms.caster import swivelled
from diffbot_sim.identification.free_forms.forms import Growth, Spans
from diffbot_sim.identification.free_forms.past import PAST
from diffbot_sim.identification.free_forms.quantities import (
    share_of_force,
    share_of_turning,
    turning_of_wheels,
)
from diffbot_sim.identification.free_forms.starting import START, rest_before, started
from diffbot_sim.identification.free_forms.swinging import swung
from diffbot_sim.identification.free_forms.turning_back import rolled_since, turned_since
from diffbot_sim.identification.free_forms.variables import VARIABLES
from diffbot_sim.identification.free_forms.warmth import lately
from diffbot_sim.identification.free_forms.winding import Winding, wound
from diffbot_sim.identification.recordings.stretches import whole
from diffbot_sim.physics import Model


@pytest.fixture(scope='module')
def view() -> View:
    run = rehearse(Model(), random_forces(5, 20.0, -9.0, 11.0), Surroundings(), 5)
    (stretch,) = whole([run])
    space = Space(Model(), ())
    fit = Fit(space, (stretch,), space.prior(), FIRST_GAINS, np.ones(2))
    return View(fit, stretch, predictions(fit, [stretch])[0])


def test_share_of_the_force_is_of_the_same_one_wherever_it_is_told(view: View) -> None:
    run = view.stretch.run
    weaker = replace(run, commands=replace(run.commands, force=0.5 * run.commands.force))
    elsewhere = replace(view, stretch=whole([weaker])[0])
    assert np.abs(share_of_force(view)).max() == pytest.approx(1.0, abs=0.01)
    np.testing.assert_allclose(share_of_force(elsewhere), 0.5 * share_of_force(view))


@pytest.mark.parametrize(
    'name', ['v', 'omega', 'time', 'cornering', 'wheel_force', 'place_x', 'hill_y']
)
def test_hats_add_up_to_the_weight(view: View, name: str) -> None:
    form = VARIABLES[name].form
    weights = {
        'place_x': np.sign(view.wheel_speed),
        'hill_y': np.sin(view.stretch.heading)[:, None],
    }
    weight = weights.get(name, np.ones(1))
    for knots in form.grids([view]):
        total = form.columns(view, knots).sum(axis=1)
        np.testing.assert_allclose(total, np.broadcast_to(weight, total.shape), atol=1e-12)


@pytest.mark.parametrize('name', list(VARIABLES))
def test_every_form_draws_as_many_functions_as_it_shows(view: View, name: str) -> None:
    form = VARIABLES[name].form
    for grid in form.grids([view]):
        points, design = form.curve(grid)
        assert len(points) == len(design)
        shared = form.columns(view, grid).shape[1] // len(VARIABLES[name].parts)
        assert design.shape[1] == shared


@pytest.mark.parametrize('name', list(VARIABLES))
def test_every_variable_tells_what_its_curve_is_drawn_over_with_its_unit(name: str) -> None:
    assert VARIABLES[name].over.endswith(']')


@pytest.mark.parametrize('name', ['rolling', 'turning'])
def test_friction_is_alike_both_ways(view: View, name: str) -> None:
    form = VARIABLES[name].form
    *_, knots = form.grids([view])
    points, design = form.curve(knots)
    np.testing.assert_array_equal(points, -points[::-1])
    np.testing.assert_array_equal(design, -design[::-1])
    total = form.columns(view, knots).sum(axis=1)
    speed = {'rolling': view.wheel_speed, 'turning': view.omega[:, None]}[name]
    np.testing.assert_allclose(total, np.sign(speed), atol=1e-12)


def test_wheels_of_arcs_are_pushed_the_way_they_turn_where_they_turn_back() -> None:
    left = np.array([0.2, 0.02, 0.0, -0.02, -0.2])
    wheels, mix = np.column_stack([left + 0.8, left]), np.array([[1.0, 1.0], [0.2, -0.2]])
    view = SimpleNamespace(wheel_speed=wheels, omega=np.full(5, 2.0), mix=mix)
    np.testing.assert_allclose(share_of_turning(view)[:, 1], [0.5, 0.05, 0.0, 0.05, 0.5])
    np.testing.assert_array_equal(turning_of_wheels(view), [[1.0, -1.0]] * 5)
    assert not turning_of_wheels(SimpleNamespace(omega=np.zeros(3), mix=mix)).any()


def test_force_on_each_wheel_is_told_of_each() -> None:
    right, left = (np.ones((9, 1, 1)) * channel for channel in np.eye(2))
    both = np.concatenate([right, 0.0 * right, left, 0.0 * left], axis=1)
    basis = Basis('wheels', 'force_steps', np.array([1.0]), 0.1, 0.2, (both,))
    strengths = basis.strengths(np.array([1.0, 5.0, -4.0, 5.0]))
    assert strengths == pytest.approx({'on the right wheel': 0.1, 'on the left wheel': 0.4})


def test_curve_is_that_of_the_part_asked_for() -> None:
    pull, amounts = Basis('v', 'pull', np.array([0.0, 60.0]), 1.0, 0.2, ()), np.array([1.0, -7.0])
    along_x, along_y = (pull.curve(amounts, np.eye(2), f'along {way}')[1] for way in 'xy')
    np.testing.assert_allclose(along_y, -7.0 * along_x)


def test_caster_swings_round_where_the_robot_turns_back() -> None:
    time = np.arange(0.0, 4.0, 0.02)
    v, omega = np.where(time < 2.0, 0.5, -0.5), np.where(time < 1.0, 0.3, 0.0)
    angle = swivelled(time, v, omega, -0.2, 0.04)
    np.testing.assert_allclose(np.cos(angle[[99, -1]]), [1.0, -1.0], atol=0.01)


def test_caster_swivels_alike_with_fewer_samples() -> None:
    time = np.arange(0.0, 4.0, 0.005)
    v, omega = np.cos(time), np.sin(3.0 * time)
    fine, coarse = (swivelled(time[::n], v[::n], omega[::n], -0.3, 0.06)[-1] for n in (1, 4))
    np.testing.assert_allclose(fine, coarse, atol=0.05)


def test_caster_takes_power_and_never_gives_any(view: View) -> None:
    form = VARIABLES['caster'].form
    for place in form.grids([view]):
        power = np.einsum('kqc,kc->kq', form.columns(view, place), view.wheel_speed)
        assert power.max() <= 0.0
        assert power.min() < 0.0


def test_line_and_curve_are_tried_from_end_to_end(view: View) -> None:
    line, curve = VARIABLES['v'].form.grids([view])
    assert (len(line), len(curve)) == (2, 6)
    assert {line[0], curve[0]} == {view.v.min()}
    assert {line[-1], curve[-1]} == {view.v.max()}


def test_growth_has_no_mean_over_the_quantiles() -> None:
    form = Growth(lambda view: view.v, counts=(5,))
    _, design = form.curve(np.linspace(0.0, 1.0, 5))
    np.testing.assert_allclose(np.array([0.5, 1.0, 1.0, 1.0, 0.5]) @ design, 0.0, atol=1e-12)
    assert np.linalg.matrix_rank(design) == 4


def test_friction_after_a_rest_acts_as_wheels_start(view: View) -> None:
    count = len(view.stretch.time)
    right = np.where(np.arange(count) % 100 < 40, 0.0, -0.2)
    twist = np.column_stack([0.5 * right, 0.5 * right / view.fit.model.half_separation])
    stop_and_go = replace(view, prediction=replace(view.prediction, twist=twist))
    interval = view.stretch.interval
    rolling = np.arange(count) % 100 >= 40
    assert rest_before(stop_and_go)[rolling, 0] == pytest.approx(np.log(39 * interval))
    begun = (np.arange(count) % 100 - 39) * interval
    backward = started(stop_and_go)[:, 0] < 0.0
    assert np.all(backward[rolling & (begun < START - 0.5 * interval)])
    assert not np.any(backward[~rolling | (begun > START + 0.5 * interval)])
    assert not np.any(started(stop_and_go)[:, 1])


def test_warmth_rises_to_the_speed_and_fades_at_rest() -> None:
    time = np.arange(0.0, 60.0, 0.01)
    mean = lately(np.where(time < 30.0, 0.5, 0.0)[:, None], time, 10.0)[:, 0]
    at = np.searchsorted(time, (10.0, 30.0, 40.0))
    warm = 0.5 * (1.0 - np.exp(-3.0))
    expected = (0.5 * (1.0 - np.exp(-1.0)), warm, warm * np.exp(-1.0))
    np.testing.assert_allclose(mean[at], expected, rtol=1e-3)


def test_way_since_a_wheel_turned_back_goes_on_over_a_rest(view: View) -> None:
    time = view.stretch.time
    speed = np.select([time < 5.0, time < 8.0, time < 11.0], [0.4, -0.2, 0.0], -0.2)
    there_and_back = np.column_stack([speed, np.zeros(len(time))])
    seen = replace(view, prediction=replace(view.prediction, twist=there_and_back))
    at = np.searchsorted(time, (4.0, 6.0, 10.0, 12.0))
    np.testing.assert_allclose(rolled_since(seen)[at, 0], (1.6, 0.2, 0.6, 0.8), atol=0.01)
    assert not np.any(turned_since(seen))


def test_spans_that_never_occur_are_not_tried(view: View) -> None:
    form = Spans(
        turned_since, lambda view: np.ones(len(view.v)), ((0.0, 0.1), (0.0, 0.1, 1e6, 1e7))
    )
    (edges,) = form.grids([view])
    np.testing.assert_array_equal(edges, (0.0, 0.1))


def test_what_swings_at_the_rate_of_a_drive_swings_most() -> None:
    time = np.arange(0.0, 20.0, 0.02)
    wave = np.sin(2.0 * np.pi * 1.0 * time)
    largest = [np.abs(swung(time, wave, rate)).max() for rate in (0.5, 1.0, 2.0)]
    assert largest[1] > 4.0 * max(largest[0], largest[2])


def test_what_swings_does_so_alike_with_fewer_samples() -> None:
    time = np.linspace(0.0, 4.0, 401)
    fine, coarse = (swung(t, np.tanh(t), 0.8)[-1] for t in (time, time[::4]))
    np.testing.assert_allclose(coarse, fine, rtol=0.01, atol=2e-3)


def test_past_of_a_steady_command_is_that_command(view: View) -> None:
    command = view.stretch.run.commands.force[0]
    np.testing.assert_allclose(view.past_force(-1e-9, 0.0)[0], command, atol=1e-6)


def test_spans_of_the_past_average_the_command(view: View) -> None:
    spans = [view.past_force(*span) for span in pairwise(PAST)]
    widths = np.diff(PAST)
    joined = sum(width * span for width, span in zip(widths, spans, strict=True)) / PAST[-1]
    np.testing.assert_allclose(joined, view.past_force(0.0, PAST[-1]), atol=1e-9)


@pytest.mark.parametrize(
    ('axis', 'force', 'torque'), [('wheels', 3.0, -0.2), ('difference', -1.0, 0.6)]
)
def test_wheel_forces_push_and_turn_the_body(axis: str, force: float, torque: float) -> None:
    wheels = np.array([[[1.0, 2.0]]])
    basis = Basis(axis, 'wheel_speed', np.empty(0), 1.0, 0.2, (wheels,))
    np.testing.assert_allclose(basis.push(0, 0), [[force, torque]])


def test_what_has_wound_up_one_way_winds_up_the_other_way_once_the_wheel_turns_back() -> None:
    time = np.arange(0.0, 20.0, 0.01)
    speed = np.where(time < 10.0, 0.2, -0.2)
    parts = wound(time, np.column_stack([speed, 0.0 * speed]), 0.1)
    since, (forward,) = (x.T for x in Winding().curve(np.array([0.1])))
    back = np.searchsorted(time, 10.0) + np.rint(since / 0.002).astype(int)
    np.testing.assert_allclose(parts[back, 0], -forward, atol=0.01)
    assert not np.any(parts[:, 1])
