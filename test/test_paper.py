"""The paper's experiments: every claim holds, every figure is made, and bad input is told."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from diffbot_sim.__main__ import main
from diffbot_sim.errors import ConfigError
from diffbot_sim.paper.catalogue import ERRATA, EXPERIMENTS, chosen
from diffbot_sim.paper.constants import load_constants
from diffbot_sim.paper.sensitivity import first_failure, range_of
from diffbot_sim.paper.writing import FOLDER, Outcome, page

ROOT = Path(__file__).parents[1]
CONSTANTS = load_constants()
EVERY = (*EXPERIMENTS, *ERRATA)


def outcome(experiment):
    return Outcome(experiment, experiment.claims(CONSTANTS, experiment.run(CONSTANTS)))


def refusal(capsys, *words):
    """Run the command, which must fail with one line, and return the line."""
    assert main(['paper', *map(str, words)]) == 1
    (line,) = [text for text in capsys.readouterr().err.splitlines() if text.startswith('error')]
    return line


@pytest.mark.parametrize('experiment', EVERY, ids=lambda experiment: experiment.name)
def test_every_claim_holds(experiment):
    claims = outcome(experiment).claims
    assert claims
    assert [claim for claim in claims if not claim.holds] == []


@pytest.mark.parametrize(
    ('section', 'name', 'value', 'fails'),
    [
        ('friction', 'mu_static', 0.0505, 'Fig. 11: both forces exceed'),
        ('friction', 'stribeck', 20.0, 'Fig. 5: the Stribeck curve'),
        ('friction', 'mu_viscous', 0.0, 'section 2.3: viscous friction grows'),
        ('gains', 'ki', 0.02, 'Fig. 13: the inner loop suppresses'),
    ],
)
def test_claims_fail_where_constants_contradict_the_text(section, name, value, fails):
    part = replace(getattr(CONSTANTS, section), **{name: value})
    assert first_failure(replace(CONSTANTS, **{section: part})).startswith(fails)


@pytest.mark.parametrize('name', ['mu_coulomb', 'mu_viscous'])
def test_claims_about_friction_that_is_not_there_fail_and_no_more(name):
    without = replace(CONSTANTS, friction=replace(CONSTANTS.friction, **{name: 0.0}))
    claims = [claim for each in EVERY for claim in each.claims(without, each.run(without))]
    assert 0 < sum(claim.holds for claim in claims) < len(claims)


def test_static_friction_may_rise_until_it_exceeds_the_weaker_force():
    static = range_of(CONSTANTS, 'friction', 'mu_static')
    assert static.low < CONSTANTS.friction.mu_static < static.high
    assert static.high == pytest.approx(0.5 / CONSTANTS.friction.normal_force, rel=0.005)


def test_page_in_the_documentation_is_what_the_command_writes():
    written = (ROOT / 'docs' / 'paper.md').read_text('utf-8')
    fresh = page([outcome(experiment) for experiment in EVERY], [], None)
    assert [line for line in fresh.splitlines() if line not in written.splitlines()] == []


def test_command_writes_series_and_figures(tmp_path, capsys):
    assert main(['paper', 'fig10-12', '--out', str(tmp_path)]) == 0
    assert '7 of 7 claims hold' in capsys.readouterr().out
    names = {path.name for path in (tmp_path / FOLDER).iterdir()}
    figures = {f'fig{i}.{kind}' for i in (10, 11, 12) for kind in ('svg', 'png')}
    assert names == {'fig10-12.csv', *figures}
    rows = np.genfromtxt(tmp_path / FOLDER / 'fig10-12.csv', delimiter=',', names=True)
    assert rows['v_ms'][-1] == 0.0 < rows['v_ms'].max()


def test_figures_are_the_same_byte_for_byte_each_time(tmp_path):
    for name in ('one', 'two'):
        main(['paper', 'fig8', '--out', str(tmp_path / name)])
    for file in ('fig8.svg', 'fig8.png', 'fig8.csv'):
        one, two = ((tmp_path / name / FOLDER / file).read_bytes() for name in ('one', 'two'))
        assert one == two


def test_unknown_experiment_is_told_with_a_suggestion(tmp_path, capsys):
    line = refusal(capsys, 'fig3', '--out', tmp_path / 'out')
    assert 'fig3: unknown experiment' in line
    assert "Did you mean 'fig" in line
    assert not (tmp_path / 'out').exists()


def test_folder_that_cannot_be_made_is_told(tmp_path, capsys):
    (tmp_path / 'file').touch()
    assert 'is a file' in refusal(capsys, '--out', tmp_path / 'file')


@pytest.mark.parametrize(
    ('text', 'told'),
    [
        ('robot: {mass: -2.0}', 'robot.mass: -2.0 is not valid'),
        ('friction: {mu_static: 0.01, mu_coulomb: 0.02}', 'exceeds friction.mu_static'),
        ('friction: {model: coulomb}', "Give 'generalized'"),
        ('effects: {slope: {grade_x: 0.1}}', 'effects (slope)'),
        ('pi: {kq: 1.0}', 'pi.kq: unknown parameter'),
    ],
)
def test_nonsense_constants_are_told(tmp_path, capsys, text, told):
    file = tmp_path / 'constants.yaml'
    file.write_text(f'/**:\n  ros__parameters:\n    {text}\n')
    assert told in refusal(capsys, '--constants', file, '--out', tmp_path)


def test_missing_constants_file_is_told(tmp_path):
    with pytest.raises(ConfigError, match='there is no such file'):
        load_constants(tmp_path / 'none.yaml')


def test_sensitivity_is_refused_where_a_claim_fails_already(tmp_path, capsys):
    file = tmp_path / 'constants.yaml'
    file.write_text('/**:\n  ros__parameters:\n    friction: {mu_static: 0.06}\n')
    line = refusal(capsys, 'fig8', '--sensitivity', '--constants', file, '--out', tmp_path)
    assert 'a claim fails already' in line


def test_experiments_are_found_by_name_in_the_order_asked_for():
    assert [experiment.name for experiment in chosen(['fig9', 'fig8'])] == ['fig9', 'fig8']
