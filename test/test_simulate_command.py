"""`simulate`: a bag and a parameter file in, the predicted bag out."""

from pathlib import Path

import numpy as np
import pytest
from drives import START, TIME, drive

from diffbot_sim.__main__ import main
from diffbot_sim.bags import read_run, write_run
from diffbot_sim.config import save_model
from diffbot_sim.physics import Model, simulate
from diffbot_sim.physics.effects.quadratic_drag import QuadraticDrag
from diffbot_sim.physics.state import State
from diffbot_sim.records import Odometry, Run

MODEL = Model().with_effect(QuadraticDrag(6.0))


@pytest.fixture
def bag(tmp_path: Path) -> Path:
    """Return a bag driven by MODEL, its run time starting before the odometry."""
    late, commands = TIME[10:], drive().commands
    moved = simulate(MODEL, commands, late, State(1.0, 2.0, 3.0, 0.4, 0.5))
    measured = Odometry(late, moved.twist, moved.pose)
    write_run(tmp_path / 'drive', Run('drive', commands, measured), START)
    save_model(MODEL, tmp_path / 'robot.yaml')
    return tmp_path / 'drive'


def words(bag: Path, params: str = 'robot.yaml', out: str = 'out') -> list[str]:
    folder = bag.parent
    return ['simulate', str(bag), '--params', str(folder / params), '--out', str(folder / out)]


def test_the_right_model_predicts_what_was_recorded(bag, capsys):
    assert main(words(bag)) == 0
    recorded, predicted = read_run(bag), read_run(bag.parent / 'out')
    measured, odometry = recorded.run.odometry, predicted.run.odometry
    np.testing.assert_array_equal(predicted.stamps, recorded.stamps)
    np.testing.assert_allclose(odometry.twist, measured.twist, atol=1e-8)
    np.testing.assert_allclose(odometry.pose, measured.pose, atol=1e-8)
    assert f'prediction: {bag.parent / "out"}' in capsys.readouterr().out


def test_topics_can_be_named(bag):
    named = ['--left-force', 'right_wheel/force', '--right-force', 'left_wheel/force']
    assert main([*words(bag), *named]) == 0
    predicted = read_run(bag.parent / 'out').run
    assert predicted.commands.force[0, 0] == drive().commands.force[10, 1]


@pytest.mark.parametrize(
    ('text', 'expected'),
    [
        ('effects: {quadratic_drg: {}}', "Did you mean 'quadratic_drag'?"),
        ('robot: {mass: -1.0}', 'robot.mass: -1.0 is not valid'),
        ('friction: {mu_coulomb: 1.0}', 'exceeds friction.mu_static'),
    ],
)
def test_a_wrong_parameter_is_one_line_and_nothing_is_written(bag, capsys, text, expected):
    (bag.parent / 'wrong.yaml').write_text(f'/**: {{ros__parameters: {{{text}}}}}')
    assert main(words(bag, 'wrong.yaml')) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert expected in line
    assert not (bag.parent / 'out').exists()


@pytest.mark.parametrize('out', ['drive', 'robot.yaml', 'robot.yaml/below'])
def test_results_never_replace_what_was_given(bag, capsys, out):
    before = {file: file.read_bytes() for file in bag.parent.rglob('*') if file.is_file()}
    assert main(words(bag, out=out)) == 1
    assert 'Choose another folder for --out.' in capsys.readouterr().err
    assert all(file.read_bytes() == content for file, content in before.items())


def test_a_bag_that_is_not_there_is_told(bag, capsys):
    assert main(words(bag.parent / 'nothing')) == 1
    assert capsys.readouterr().err == f'error: {bag.parent / "nothing"}: there is no such bag.\n'
