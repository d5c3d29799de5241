"""The command line: what it offers, what it answers, how it ends."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from diffbot_sim.__main__ import main
from diffbot_sim.commands import simulate
from diffbot_sim.errors import DiffbotError
from diffbot_sim.physics.effects import library

ROOT = Path(__file__).parents[1]


def refused(capsys: pytest.CaptureFixture[str], *words: str) -> str:
    with pytest.raises(SystemExit) as stop:
        main(words)
    assert stop.value.code == 2
    return capsys.readouterr().err


def shown(capsys: pytest.CaptureFixture[str], *words: str) -> str:
    with pytest.raises(SystemExit) as stop:
        main(words)
    assert stop.value.code == 0
    return capsys.readouterr().out


def ended_by(problem: BaseException, monkeypatch: pytest.MonkeyPatch) -> int:
    def run(arguments: object) -> None:
        raise problem

    monkeypatch.setattr(simulate, 'run', run)
    return main(['simulate', 'BAG', '--params', 'FILE', '--out', 'DIR'])


def test_help_lists_the_offline_tools_with_a_line_each(capsys):
    text = shown(capsys, '--help')
    for file in (ROOT / 'diffbot_sim' / 'commands').glob('[a-z]*.py'):
        (line,) = (line for line in text.splitlines() if line.startswith(f'  {file.stem} '))
        assert len(line.split()) > 3


def test_help_of_simulate_lists_every_effect_and_parameter(capsys):
    text = shown(capsys, 'simulate', '--help')
    for name, kind in library().items():
        assert f'  {name}: {kind.meaning}' in text
        assert all(f'    {spec.name}: {spec.meaning}' in text for spec in kind.specs())


def test_a_command_may_be_named_apart_from_its_words(capsys):
    with pytest.raises(SystemExit):
        main(['--help'], 'simulate')
    assert 'usage: diffbot_sim simulate' in capsys.readouterr().out


def test_version_is_told(capsys):
    assert shown(capsys, '--version').startswith('diffbot_sim 0.')


def test_wrong_usage_is_told_with_what_is_there(capsys):
    assert 'give a COMMAND' in refused(capsys)
    assert "Did you mean 'simulate'?" in refused(capsys, 'simulat', 'bag')
    assert 'arguments are required: --params, --out' in refused(capsys, 'simulate')


def test_an_interrupt_ends_quietly(monkeypatch, capsys):
    assert ended_by(KeyboardInterrupt(), monkeypatch) == 130
    assert capsys.readouterr().err == ''


def test_a_fault_of_the_system_is_told_in_one_line(monkeypatch, capsys):
    assert ended_by(OSError(28, 'No space left on device', 'out.mcap'), monkeypatch) == 1
    assert capsys.readouterr().err == "error: [Errno 28] No space left on device: 'out.mcap'\n"


def test_a_fault_of_several_lines_is_told_in_one(monkeypatch, capsys):
    assert ended_by(DiffbotError('first\n  second'), monkeypatch) == 1
    assert capsys.readouterr().err == 'error: first second\n'


def test_a_reader_who_leaves_is_no_problem(monkeypatch, capsys, tmp_path):
    with (tmp_path / 'pipe').open('w') as pipe:
        monkeypatch.setattr(sys, 'stdout', pipe)
        assert ended_by(BrokenPipeError(), monkeypatch) == 1
        print('what nobody reads', flush=True)
    assert (tmp_path / 'pipe').read_text() == capsys.readouterr().err == ''


def test_a_node_without_ros_says_what_to_install():
    words = "import sys; sys.modules['rclpy'] = None; from diffbot_sim.__main__ import main; "
    words += "sys.exit(main(['simulator']))"
    alone = subprocess.run(
        [sys.executable, '-c', words], capture_output=True, text=True, check=False
    )
    assert alone.returncode == 1
    assert "simulator needs 'rclpy', which is not installed. Source" in alone.stderr


def test_a_folder_without_a_name_is_refused(capsys):
    words = ('simulate', 'BAG', '--params', 'FILE', '--out', '')
    assert 'argument --out: the name of the folder is empty' in refused(capsys, *words)


def test_a_terminal_that_lacks_letters_ends_no_command():
    command = [sys.executable, '-m', 'diffbot_sim', 'simulate', '--help']
    ascii_only = {**os.environ, 'PYTHONIOENCODING': 'ascii'}
    told = subprocess.run(command, env=ascii_only, cwd=ROOT, capture_output=True, check=False)
    assert told.returncode == 0
    assert b'imbalance ? of the gains' in told.stdout


def test_a_command_whose_output_is_closed_ends_well(monkeypatch):
    monkeypatch.setattr(simulate, 'run', lambda arguments: None)
    monkeypatch.setattr(sys, 'stdout', None)
    assert main(['simulate', 'BAG', '--params', 'FILE', '--out', 'DIR']) == 0
