"""What is written about an identification."""

import io
import json
import re
from base64 import b64decode
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import identification_by_hand as by_hand
import numpy as np
import plotly.graph_objects as go
import pytest
from browser import browsed, needs_chromium
from rich.console import Console

from diffbot_sim.identification.result import Bias, ErrorNorm, Estimate, Identification, Timing
from diffbot_sim.physics.effects import library, sought_effects
from diffbot_sim.physics.effects.effective_track import EffectiveTrack
from diffbot_sim.physics.friction import Friction
from diffbot_sim.physics.model import Model
from diffbot_sim.report import figures, print_summary, sentences, write_report
from diffbot_sim.report.dependence import binned
from diffbot_sim.report.numerals import estimate_text, significant
from diffbot_sim.report.rows import kept_rows

Answer = Callable[[], Identification]
ANSWERS = [by_hand.nothing_missing, by_hand.found, by_hand.unexplained]
every_verdict = pytest.mark.parametrize('answer', ANSWERS)


def summary(result: Identification) -> str:
    """Return what a pipe of 80 columns receives."""
    out = io.StringIO()
    print_summary(result, Console(file=out, width=80))
    return out.getvalue()


def one_odd_run() -> Identification:
    """Return an answer in which the second of three runs carried a load."""
    runs = (
        by_hand.check('first drive'),
        by_hand.check('second drive', 12.9),
        by_hand.check('third drive'),
    )
    return replace(by_hand.found(), runs=runs)


@every_verdict
def test_json_has_the_keys_that_other_programs_rely_on(answer: Answer) -> None:
    report = json.loads(by_hand.as_json(answer()))
    assert {'verdict', 'effects', 'unexplained', 'nominal', 'error', 'candidates'} <= set(report)
    assert report['nominal']['parameters']['mass']['ci95'] == [10.171, 10.255]
    error = report['error']
    assert error['split'] == 'held_out'
    for name in ('declared', 'recalibrated', 'with_effects', 'noise_floor'):
        assert set(error[name]) == {'v_rmse', 'omega_rmse'}


def test_json_tells_a_found_effect_with_interval_evidence_and_alternatives() -> None:
    effect = json.loads(by_hand.as_json(by_hand.found()))['effects'][0]
    assert effect['name'] == 'quadratic_drag'
    assert {'value', 'ci95', 'unit'} <= set(effect['parameters']['coefficient'])
    assert effect['evidence']['delta_bic'] == 812.4
    assert effect['alternatives'] == ['slope']


def test_json_tells_errors_by_horizon() -> None:
    horizons = json.loads(by_hand.as_json(by_hand.found()))['horizons']
    assert [item['name'] for item in horizons] == ['one step', '1 s', '5 s', 'free-running']
    assert [item['seconds'] for item in horizons] == [0.02, 1.0, 5.0, None]
    assert set(horizons[0]['declared']) == {'v_rmse', 'omega_rmse'}


def test_json_tells_which_run_disagrees_and_why() -> None:
    first, second = json.loads(by_hand.as_json(one_odd_run()))['runs'][:2]
    assert (first['name'], first['agrees'], first['why']) == ('first drive', True, '')
    assert (second['name'], second['agrees'], second['v_rmse']) == ('second drive', False, 0.098)
    assert second['why'] == 'mass 12.900 ± 0.100 kg, elsewhere 10.010 ± 0.050 kg'
    assert second['differences'][0]['here']['value'] == 12.9
    assert set(second['noise_floor']) == set(second['declared']) == {'v_rmse', 'omega_rmse'}


@pytest.mark.parametrize('told', [by_hand.page, by_hand.as_json])
def test_reader_learns_of_what_was_read(told: Callable[[Identification], str]) -> None:
    text = told(by_hand.found())
    said = ('drives/first', 'drives/second', 'robot.yaml', '2026-11-28', '0.1.0')
    assert all(word in text for word in said)


def test_one_run_has_nothing_to_agree_with() -> None:
    (run,) = json.loads(by_hand.as_json(by_hand.nothing_missing()))['runs']
    assert (run['agrees'], run['why'], run['v_rmse']) == (None, None, None)
    assert 'Do the runs agree' not in by_hand.page(by_hand.nothing_missing())


@pytest.mark.parametrize('told', [by_hand.page, summary])
def test_run_that_disagrees_is_named_at_once(told: Callable[[Identification], str]) -> None:
    text = ' '.join(told(one_odd_run()).split())
    said = 'second drive disagrees with the other runs: mass 12.900 ± 0.100 kg'
    table = 'Error before and after' if '<' in text else 'Free-running error'
    assert text.index(said) < text.index(table)


@pytest.mark.parametrize('told', [by_hand.page, summary])
def test_reader_learns_when_twists_were_not_taken_as_stamped(
    told: Callable[[Identification], str],
) -> None:
    late = [
        Timing('first drive', 0.0102, 'mean'),
        Timing('second drive', 0.05, 'pose'),
        Timing('third drive', 0.04, 'filter'),
        Timing('fourth drive', 0.01, 'undecided'),
    ]
    text = ' '.join(told(replace(by_hand.nothing_missing(), timings=tuple(late))).split())
    assert 'first drive: the twists were taken as 10.2 ms older than their stamps' in text
    assert 'second drive: the twists are means over what the poses tell, 50 ms late' in text
    assert (
        'third drive: the twists were taken as they were before a filter that delays them' in text
    )
    assert 'fourth drive: the twists may be 10 ms older than their stamps' in text


@pytest.mark.parametrize('told', [by_hand.page, summary])
def test_reader_learns_that_wheels_creep_near_rest(told: Callable[[Identification], str]) -> None:
    yielding = replace(by_hand.nothing_missing(), near_rest=90.0)
    assert 'Friction near rest is of another form' in ' '.join(told(yielding).split())
    assert 'Friction near rest' not in told(by_hand.nothing_missing())


@pytest.mark.parametrize('told', [by_hand.page, summary])
def test_reader_learns_which_noise_was_added(told: Callable[[Identification], str]) -> None:
    exact = replace(by_hand.nothing_missing(), added_noise=ErrorNorm(0.003, 0.014))
    text = ' '.join(told(exact).split())
    assert 'white noise of 3.00 mm/s and 14.0 mrad/s was added' in text


@pytest.mark.parametrize('told', [by_hand.page, summary])
def test_reader_learns_which_bias_was_taken_off(told: Callable[[Identification], str]) -> None:
    biased = replace(by_hand.nothing_missing(), biases=(Bias('first drive', 0.0071),))
    text = ' '.join(told(biased).split())
    assert 'first drive: the odometry turns by 7.10 mrad/s while the robot stands' in text


def test_of_two_runs_that_disagree_neither_is_called_odd() -> None:
    runs = by_hand.check('a', 12.9), by_hand.check('b', 10.0)
    (said,) = sentences.disagreements(runs)
    assert said.startswith('a and b disagree. a: mass 12.90')
    (turned,) = sentences.disagreements([by_hand.check('a'), by_hand.check('b', 12.9)])
    assert turned.startswith('a and b disagree. b: mass 12.90')


@pytest.mark.parametrize('told', [by_hand.page, summary])
def test_errors_are_told_by_horizon(told: Callable[[Identification], str]) -> None:
    text = told(by_hand.found())
    assert all(name in text for name in ('one step', '1 s', '5 s'))


def test_parameter_at_its_bound_is_marked() -> None:
    stopped = Estimate(0.0, -0.1, 0.1, 'N', at_bound=True)
    result = replace(by_hand.found(), nominal={'mu_viscous': stopped})
    assert '(at bound)' in by_hand.page(result)
    estimates = json.loads(by_hand.as_json(result))['nominal']['parameters']
    assert estimates['mu_viscous']['at_bound'] is True


@pytest.mark.parametrize('told', [by_hand.as_json, by_hand.page, summary])
def test_pure_number_has_no_minus_for_a_unit(told: Callable[[Identification], str]) -> None:
    told_text = re.sub(r'<script>.*?</script>', '', told(by_hand.found('slope')), flags=re.DOTALL)
    assert not re.search(r"""["'>\d]\s*-\s*["'<,]|\[-\]|\d -$""", told_text, re.MULTILINE)


@pytest.mark.parametrize(
    'words', ['without slipping', 'Wheel separation', 'tilted evenly', 'start-up', 'three tests']
)
def test_page_says_what_was_assumed(words: str) -> None:
    said = by_hand.page(by_hand.found())
    assert words in said[said.index('What was assumed') :]


def test_what_was_noticed_in_the_bags_is_told_where_it_is_read() -> None:
    said = by_hand.page(by_hand.found())
    assert by_hand.NOTES[0] in said[said.index('What was assumed') :]
    assert json.loads(by_hand.as_json(by_hand.found()))['origin']['notes'] == [*by_hand.NOTES]


def test_json_tells_numbers_in_full_precision() -> None:
    third = replace(by_hand.errors(0.03), declared=by_hand.ErrorNorm(1 / 3, 2 / 3))
    report = json.loads(by_hand.as_json(replace(by_hand.found(), errors=third)))
    assert report['error']['declared'] == {'v_rmse': 1 / 3, 'omega_rmse': 2 / 3}


@every_verdict
def test_json_has_null_where_there_is_no_number(answer: Answer) -> None:
    text = by_hand.as_json(replace(answer(), nominal={'m': Estimate(1.0, -np.inf, np.inf, 'kg')}))
    assert not re.search(r'NaN|Infinity', text)
    assert json.loads(text)['nominal']['parameters']['m']['ci95'] == [None, None]
    assert json.loads(text)['candidates'][1]['p_block'] is None


@every_verdict
@pytest.mark.parametrize('with_pose', [True, False])
def test_page_loads_nothing_from_elsewhere(
    answer: Callable[..., Identification], with_pose: bool
) -> None:
    page = by_hand.page(answer(with_pose=with_pose))
    head = re.sub(r'<script>.*?</script>', '', page, flags=re.DOTALL)
    assert not re.search(r"""(src|href|url)\s*[=(]\s*["']?(https?:)?//""", head)
    assert '@import' not in head
    assert ('Path in the plane' in page) == with_pose


@every_verdict
def test_page_says_the_verdict(answer: Answer) -> None:
    result = answer()
    assert f'<h1 id="verdict">{sentences.verdict(result)}</h1>' in by_hand.page(result)


def test_page_cannot_be_broken_by_a_name() -> None:
    evil = '</script><script>alert(1)</script>'
    result = by_hand.found()
    runs = tuple(replace(run, run=evil) for run in result.comparisons)
    structure = replace(by_hand.unexplained().unexplained, variable=evil, description=evil)
    page = by_hand.page(replace(result, comparisons=runs, unexplained=structure, advice=(evil,)))
    assert '<script>alert' not in page


@pytest.mark.parametrize('name', sorted(sought_effects()))
def test_every_effect_of_the_library_can_be_told(name: str) -> None:
    result = by_hand.found(name)
    assert library()[name].meaning[1:60] in by_hand.page(result).replace('&#39;', "'")
    assert name in summary(result)
    assert json.loads(by_hand.as_json(result))['effects'][0]['name'] == name


def test_answer_without_runs_or_candidates_can_be_told() -> None:
    bare = replace(by_hand.nothing_missing(), comparisons=(), candidates=(), nominal={})
    assert 'Nothing missing' in by_hand.page(bare)
    assert 'Nothing missing' in summary(bare)


@pytest.mark.parametrize(
    ('over', 'knots', 'drawn', 'scale'),
    [
        ('heading [rad]', np.radians([-180.0, 180.0]), [-180.0, 180.0], None),
        ('rest [ln s]', np.log([0.2, 4.0]), [0.2, 4.0], 'log'),
        ('speed v [m/s]', np.array([-1.0, 1.0]), [-1.0, 1.0], None),
    ],
)
def test_curves_are_drawn_in_units_that_people_read(
    over: str, knots: np.ndarray, drawn: list[float], scale: str | None
) -> None:
    left = by_hand.unexplained().unexplained
    two = np.ones(2)
    figure = figures.structure_figure(
        replace(left, over=over, knots=knots, force=two, force_error=two)
    )
    axis, x = figure.layout['xaxis'], figure.data[-1]['x']
    assert np.frombuffer(b64decode(x['bdata']), x['dtype']) == pytest.approx(drawn)
    assert axis.get('type') == scale
    assert 'ln' not in axis['title']['text']


@every_verdict
def test_figures_are_valid_and_small(answer: Answer) -> None:
    result = answer()
    drawn = [*figures.error_figures(result.errors), figures.candidates_figure(result)]
    drawn += figures.residual_figures(result) + figures.disturbance_figures(result)
    for run in result.comparisons:
        drawn += figures.run_figures(result, run)
    for figure in drawn:
        go.Figure(figure.data, figure.layout)
        assert len(json.dumps(figure.data)) < 2e6


def test_residual_is_drawn_first_against_the_variable_that_explains_it() -> None:
    first = figures.residual_figures(by_hand.found())[0]
    assert first.title in ('v against speed v', 'v against traction force')
    assert re.match(r'Explains [89]\d % recalibrated, \d % with effects', first.note)


def test_noise_explains_nothing_and_a_curve_explains_all() -> None:
    rng = np.random.default_rng(2)
    x, noise = rng.uniform(-1.0, 1.0, 5000), rng.normal(size=5000)
    assert binned(x, noise).explained < 0.02
    assert binned(x, x**2).explained > 0.98
    assert len(binned(np.full(9, np.nan), np.ones(9)).x) == 0


@every_verdict
def test_terminal_summary_fits_80_plain_columns(answer: Answer) -> None:
    text = summary(answer())
    assert max(map(len, text.splitlines())) <= 80
    assert '\x1b' not in text
    assert 'mm/s' in text
    assert 'noise floor' in text


def test_verdict_tells_of_the_axis_that_improved() -> None:
    turning = replace(by_hand.errors(0.0041), recalibrated=by_hand.ErrorNorm(0.0041, 0.2))
    said = sentences.verdict(replace(by_hand.found('yaw_friction'), errors=turning))
    assert 'turn-rate error falls from 200 mrad/s to 8.10 mrad/s' in said


def test_verdict_tells_of_the_axis_that_is_wrong_where_none_improved() -> None:
    spins = by_hand.ErrorNorm(0.0041, 0.7)
    wrong = replace(by_hand.errors(0.0041), recalibrated=spins, with_effects=spins)
    said = sentences.verdict(replace(by_hand.unexplained(), errors=wrong))
    assert 'held-out turn-rate error 700 mrad/s; noise floor 8.00 mrad/s' in said


@pytest.mark.parametrize(('factors', 'told'), [((0.1, 0.11), True), ((0.1, 1.0), False)])
def test_forces_in_another_unit_are_suspected(factors: tuple[float, float], told: bool) -> None:
    robot = Model().robot
    mass, inertia = factors[0] * robot.mass, factors[1] * robot.inertia
    scaled = Model(replace(robot, mass=mass, inertia=inertia))
    result = replace(by_hand.nothing_missing(), identified=scaled)
    assert ('as where forces are told in another unit' in by_hand.page(result)) == told


@pytest.mark.parametrize(('widening', 'told'), [(1.02, True), (-0.49, True), (0.6, False)])
def test_half_a_wheel_separation_is_suspected(widening: float, told: bool) -> None:
    wider = Model().with_effect(EffectiveTrack(widening))
    result = replace(by_hand.nothing_missing(), identified=wider)
    assert ('is wheel_separation the whole distance' in by_hand.page(result)) == told


def test_declared_effect_that_is_not_there_is_told_at_once() -> None:
    result = replace(by_hand.nothing_missing(), contradicted=('slope',))
    said = 'slope is declared, and the recordings contradict it: remove it.'
    assert 'Nothing missing, but the declared slope is contradicted: ' in sentences.verdict(result)
    assert said in ' '.join(summary(result).split())
    assert said in by_hand.page(result)
    assert json.loads(by_hand.as_json(result))['contradicted'] == ['slope']


def test_declared_effect_of_another_size_is_told_as_found() -> None:
    result = replace(by_hand.found('slope'), contradicted=('slope',))
    assert '; contradicted: the declared slope; ' in sentences.verdict(result)
    assert sentences.of_declared(result)[0].endswith('it is found with other parameters.')


def test_parameters_beside_the_effects_found_are_told() -> None:
    nominal = json.loads(by_hand.as_json(by_hand.found()))['nominal']
    assert nominal['beside_effects']['mass']['value'] == 10.011
    assert '10.011 ± 0.044 kg' in by_hand.page(by_hand.found())
    assert 'with effects, 95' not in by_hand.page(by_hand.nothing_missing())


@pytest.mark.parametrize('result', [by_hand.nothing_missing(), by_hand.found()])
@pytest.mark.parametrize(('error', 'told'), [(0.0041, False), (0.04, True)])
def test_error_far_above_the_noise_is_not_passed_over(
    result: Identification, error: float, told: bool
) -> None:
    left = by_hand.ErrorNorm(error, 0.008)
    errors = replace(by_hand.errors(error), recalibrated=left, with_effects=left)
    assert ('uneven floor' in sentences.verdict(replace(result, errors=errors))) == told


@pytest.mark.parametrize(
    ('estimate', 'text'),
    [
        (Estimate(6.0213, 5.9, 6.14, 'N'), '6.02 ± 0.12 N'),
        (Estimate(0.1, 0.09, 0.14, '-'), '0.100 [0.090, 0.140]'),
        (Estimate(12345.0, 11000.0, 13690.0, 'kg'), '12300 ± 1300 kg'),
        (Estimate(3e-9, 2e-9, 4e-9, 'm'), '3.0e-09 ± 1.0e-09 m'),
        (Estimate(2.5, 2.5, 2.5, 's'), '2.500 s'),
        (Estimate(2.5, -np.inf, 3.0, 's'), '2.500 s (no interval)'),
        (Estimate(np.nan, 0.0, 1.0, 's'), '–'),
        (Estimate(-0.001, -0.1, 0.1, ''), '0.00 ± 0.10'),
        (Estimate(1e5, 4.95, 1e9, 'W', at_bound=True), 'above 5.0 W'),
    ],
)
def test_estimate_has_as_many_digits_as_its_interval_deserves(
    estimate: Estimate, text: str
) -> None:
    assert estimate_text(estimate) == text


def test_numbers_keep_three_digits() -> None:
    said = [significant(x) for x in (0.0, 4.1, 31.04, 1234.5, 2.5e-9, np.nan, np.inf)]
    assert said == ['0', '4.10', '31.0', '1230', '2.50e-09', '–', '–']


def test_report_replaces_an_older_one_and_leaves_no_scraps(tmp_path: Path) -> None:
    out = tmp_path / 'new' / 'report'
    write_report(by_hand.found(), by_hand.ORIGIN, out)
    write_report(by_hand.nothing_missing(), by_hand.ORIGIN, out)
    assert sorted(path.name for path in out.iterdir()) == ['report.html', 'report.json']
    assert json.loads((out / 'report.json').read_text())['verdict'] == 'nothing_missing'


@needs_chromium
@pytest.mark.parametrize('width', [390, 1280])
def test_page_is_no_wider_than_a_phone_or_a_screen(width: int, tmp_path: Path) -> None:
    write_report(one_odd_run(), by_hand.ORIGIN, tmp_path)
    assert browsed(tmp_path, width, 'dom().documentElement.scrollWidth') == str(width)


@needs_chromium
def test_browser_draws_the_figures(tmp_path: Path) -> None:
    write_report(by_hand.unexplained(), by_hand.ORIGIN, tmp_path)
    waiting = 'dom().querySelectorAll(\'script[type="application/json"]\').length'
    # The second run waits until it is chosen.
    assert browsed(tmp_path, 1200, f"drawn + ' drawn, ' + {waiting} + ' waiting'") == (
        '21 drawn, 3 waiting'
    )


def test_verdict_tells_of_the_axis_that_got_worse() -> None:
    worse = replace(by_hand.errors(0.0041), recalibrated=by_hand.ErrorNorm(0.0021, 0.0082))
    said = sentences.verdict(replace(by_hand.found('yaw_friction'), errors=worse))
    assert 'held-out speed error rises from 2.10 mm/s to 4.10 mm/s' in said


def test_kept_as_declared_is_what_the_law_uses_and_was_not_fitted() -> None:
    simple = Model(friction=Friction('coulomb_viscous'))
    names = {row.name for row in kept_rows(replace(by_hand.nothing_missing(), declared=simple))}
    assert {'wheel_separation', 'wheel_radius', 'model', 'normal_force'} <= names
    assert names.isdisjoint({'mu_static', 'stribeck'})
