"""What is written about an identification."""

import io
import json
import re
import shutil
import subprocess
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import identification_by_hand as by_hand
import numpy as np
import plotly.graph_objects as go
import pytest
from rich.console import Console

from diffbot_sim.identification.result import Estimate, Identification
from diffbot_sim.physics.effects import laws, library
from diffbot_sim.report import figures, print_summary, sentences, write_report
from diffbot_sim.report.dependence import binned
from diffbot_sim.report.json_report import json_text
from diffbot_sim.report.numerals import estimate_text, significant
from diffbot_sim.report.page import page_text

Answer = Callable[[], Identification]
ANSWERS = [by_hand.nothing_missing, by_hand.found, by_hand.unexplained]
every_verdict = pytest.mark.parametrize('answer', ANSWERS)


def summary(result: Identification) -> str:
    """Return what a pipe of 80 columns receives."""
    out = io.StringIO()
    print_summary(result, Console(file=out, width=80))
    return out.getvalue()


@every_verdict
def test_json_has_the_keys_that_other_programs_rely_on(answer: Answer) -> None:
    report = json.loads(json_text(answer()))
    assert {'verdict', 'effects', 'unexplained', 'nominal', 'error', 'candidates'} <= set(report)
    assert report['nominal']['parameters']['robot.mass']['ci95'] == [10.171, 10.255]
    error = report['error']
    assert error['split'] == 'held_out'
    for name in ('declared', 'recalibrated', 'with_effects', 'noise_floor'):
        assert set(error[name]) == {'v_rmse', 'omega_rmse'}


def test_json_tells_a_found_effect_with_interval_evidence_and_alternatives() -> None:
    effect = json.loads(json_text(by_hand.found()))['effects'][0]
    assert effect['name'] == 'quadratic_drag'
    assert set(effect['parameters']['coefficient']) == {'value', 'ci95', 'unit'}
    assert effect['evidence']['delta_bic'] == 812.4
    assert effect['alternatives'] == ['slope']


def test_json_tells_numbers_in_full_precision() -> None:
    third = replace(by_hand.errors(0.03), declared=by_hand.ErrorNorm(1 / 3, 2 / 3))
    report = json.loads(json_text(replace(by_hand.found(), errors=third)))
    assert report['error']['declared'] == {'v_rmse': 1 / 3, 'omega_rmse': 2 / 3}


@every_verdict
def test_json_has_null_where_there_is_no_number(answer: Answer) -> None:
    text = json_text(replace(answer(), nominal={'m': Estimate(1.0, -np.inf, np.inf, 'kg')}))
    assert not re.search(r'NaN|Infinity', text)
    assert json.loads(text)['nominal']['parameters']['m']['ci95'] == [None, None]
    assert json.loads(text)['candidates'][1]['p_block'] is None


@every_verdict
@pytest.mark.parametrize('with_pose', [True, False])
def test_page_loads_nothing_from_elsewhere(
    answer: Callable[..., Identification], with_pose: bool
) -> None:
    page = page_text(answer(with_pose=with_pose))
    head = re.sub(r'<script>.*?</script>', '', page, flags=re.DOTALL)
    assert not re.search(r"""(src|href|url)\s*[=(]\s*["']?(https?:)?//""", head)
    assert '@import' not in head
    assert ('Path in the plane' in page) == with_pose


@every_verdict
def test_page_says_the_verdict(answer: Answer) -> None:
    result = answer()
    assert f'<h1 id="verdict">{sentences.verdict(result)}</h1>' in page_text(result)


def test_page_cannot_be_broken_by_a_name() -> None:
    evil = '</script><script>alert(1)</script>'
    result = by_hand.found()
    runs = tuple(replace(run, run=evil) for run in result.comparisons)
    structure = replace(by_hand.unexplained().unexplained, variable=evil, description=evil)
    page = page_text(replace(result, comparisons=runs, unexplained=structure, advice=(evil,)))
    assert '<script>alert' not in page


@pytest.mark.parametrize('name', sorted(laws()))
def test_every_effect_of_the_library_can_be_told(name: str) -> None:
    result = by_hand.found(name)
    assert library()[name].meaning[1:60] in page_text(result).replace('&#39;', "'")
    assert name in summary(result)
    assert json.loads(json_text(result))['effects'][0]['name'] == name


def test_answer_without_runs_or_candidates_can_be_told() -> None:
    bare = replace(by_hand.nothing_missing(), comparisons=(), candidates=(), nominal={})
    assert 'Nothing missing' in page_text(bare)
    assert 'Nothing missing' in summary(bare)


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
    write_report(by_hand.found(), out)
    write_report(by_hand.nothing_missing(), out)
    assert sorted(path.name for path in out.iterdir()) == ['report.html', 'report.json']
    assert json.loads((out / 'report.json').read_text())['verdict'] == 'nothing_missing'


@pytest.mark.skipif(shutil.which('chromium') is None, reason='needs chromium')
def test_browser_draws_the_figures(tmp_path: Path) -> None:
    write_report(by_hand.unexplained(), tmp_path)
    quiet = ['--disable-background-networking', '--disable-component-update', '--disable-sync']
    flags = ['--headless', '--no-sandbox', '--disable-gpu', '--no-first-run', *quiet]
    where = [f'--user-data-dir={tmp_path}/profile', '--window-size=1200,9000']
    page = ['--virtual-time-budget=8000', '--dump-dom', f'file://{tmp_path}/report.html']
    command = ['chromium', *flags, *where, *page]
    dom = subprocess.run(command, capture_output=True, text=True, timeout=120, check=True).stdout
    assert dom.count('class="plot js-plotly-plot"') == 17
    assert (
        dom.count('<script type="application/json">') == 3
    )  # the second run waits until it is chosen
