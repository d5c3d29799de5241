"""`simulate --drive`: a drive and a parameter file in, a folder of documented tables out."""

import json
import sys
from pathlib import Path

import numpy as np
import pytest
from pyarrow import parquet

from diffbot_sim.__main__ import main
from diffbot_sim.config import load_drive, load_model, save_model
from diffbot_sim.drives import Drive, RandomForces
from diffbot_sim.physics import Model, simulate
from diffbot_sim.physics.effects.actuator_lag import ActuatorLag
from diffbot_sim.tables import COLUMNS, columns_of

ROOT = Path(__file__).parents[1]
MODEL = Model().with_effect(ActuatorLag(0.1))
SHORT = 'random: {duration: 4.0}'
STEPS = 'segments: [{until: 1.0, right: 6.0, left: 6.0}, {until: 2.0, right: -4.0}]'


def made(folder: Path, *options: str, drive: str = SHORT, out: str = 'set') -> int:
    save_model(MODEL, folder / 'robot.yaml')
    (folder / 'drive.yaml').write_text(drive)
    files = ['--drive', folder / 'drive.yaml', '--params', folder / 'robot.yaml']
    return main(['simulate', *map(str, [*files, '--out', folder / out]), *options])


def content(folder: Path) -> dict[str, bytes]:
    return {file.name: file.read_bytes() for file in folder.iterdir() if file.is_file()}


@pytest.mark.parametrize('form', ['npz', 'parquet'])
def test_the_same_seed_gives_the_same_bytes(tmp_path, form):
    for out in ('first', 'second'):
        assert made(tmp_path, '--runs', '2', '--seed', '5', '--format', form, out=out) == 0
    assert content(tmp_path / 'first') == content(tmp_path / 'second')


def test_a_run_does_not_depend_on_how_many_there_are(tmp_path):
    for runs in ('1', '3'):
        assert made(tmp_path, '--runs', runs, out=runs) == 0
    one, three = content(tmp_path / '1'), content(tmp_path / '3')
    assert one['run_0000.npz'] == three['run_0000.npz']
    assert len({three[f'run_000{k}.npz'] for k in range(3)}) == 3


def test_another_seed_gives_other_runs(tmp_path):
    for seed in ('0', '1'):
        assert made(tmp_path, '--runs', '2', '--seed', seed, out=seed) == 0
    runs = [content(tmp_path / seed)[f'run_000{k}.npz'] for seed in '01' for k in range(2)]
    assert len(set(runs)) == 4


def test_both_formats_hold_the_same_numbers(tmp_path):
    for form in ('npz', 'parquet'):
        assert made(tmp_path, '--format', form, out=form) == 0
    table = parquet.read_table(tmp_path / 'parquet' / 'run_0000.parquet')
    arrays = np.load(tmp_path / 'npz' / 'run_0000.npz')
    assert table.column_names == arrays.files == [column.name for column in COLUMNS]
    for name in arrays.files:
        np.testing.assert_array_equal(table[name].to_numpy(), arrays[name])


def test_a_data_set_holds_what_is_needed_to_make_a_run_again(tmp_path):
    assert made(tmp_path, '--runs', '2', '--seed', '7') == 0
    out = tmp_path / 'set'
    run = json.loads((out / 'manifest.json').read_text())['runs'][1]
    model, drive = load_model(out / 'model.yaml'), load_drive(out / 'drive.yaml')
    commands = drive.commands(run['seed'])
    again = columns_of(commands, simulate(model, commands, drive.times))
    saved = np.load(out / run['file'])
    assert all(np.array_equal(saved[name], values) for name, values in again.items())


def test_columns_are_those_of_the_motion(tmp_path):
    drive = Drive(RandomForces(5.0), 20.0)
    commands = drive.forces.commands(1)
    motion = simulate(MODEL, commands, drive.times)
    columns = columns_of(commands, motion)
    for right, left, pair in [
        ('right_force_acting', 'left_force_acting', motion.traction),
        ('right_wheel_speed', 'left_wheel_speed', motion.wheel_speed),
        ('right_wheel_angle', 'left_wheel_angle', motion.wheel_angle),
        ('right_friction', 'left_friction', motion.friction),
        ('v', 'omega', motion.twist),
    ]:
        np.testing.assert_array_equal(np.column_stack([columns[right], columns[left]]), pair)
    pose = np.column_stack([columns[name] for name in ('x', 'y', 'yaw')])
    np.testing.assert_array_equal(pose, motion.pose)


def test_commanded_force_is_the_one_held_at_the_row_and_acting_force_lags(tmp_path):
    assert made(tmp_path, drive=STEPS) == 0
    run = np.load(tmp_path / 'set' / 'run_0000.npz')
    at = np.searchsorted(run['time'], 1.0)
    assert list(run['right_force_commanded'][at - 1 : at + 1]) == [6.0, -4.0]
    assert run['right_force_acting'][0] == 0.0
    assert run['right_force_acting'][at] == pytest.approx(6.0, abs=1e-3)
    assert -4.0 < run['right_force_acting'][at + 1] < 6.0


def test_the_rate_does_not_change_the_drive(tmp_path):
    for rate in ('50', '100'):
        assert made(tmp_path, drive=f'{SHORT}\nrate: {rate}', out=rate) == 0
    slow, fast = (np.load(tmp_path / rate / 'run_0000.npz') for rate in ('50', '100'))
    for name in ('time', 'right_force_commanded'):
        np.testing.assert_array_equal(fast[name][::2], slow[name])
    np.testing.assert_allclose(fast['x'][::2], slow['x'], atol=1e-9)


def test_columns_are_described_in_the_manifest_in_the_schema_and_in_the_documentation(tmp_path):
    assert made(tmp_path, '--format', 'parquet') == 0
    manifest = json.loads((tmp_path / 'set' / 'manifest.json').read_text())['columns']
    schema = parquet.read_schema(tmp_path / 'set' / 'run_0000.parquet')
    page = (ROOT / 'docs' / 'training.md').read_text()
    assert json.loads(schema.metadata[b'columns']) == manifest
    for name, unit, meaning in COLUMNS:
        assert manifest[name] == {'unit': unit, 'meaning': meaning}
        assert f'| `{name}` | {unit} | {meaning} |' in page


def test_random_stands_for_the_default_drive(tmp_path):
    save_model(Model(), tmp_path / 'robot.yaml')
    words = ['--params', str(tmp_path / 'robot.yaml'), '--out', str(tmp_path / 'set')]
    assert main(['simulate', '--drive', 'random', *words]) == 0
    assert load_drive(tmp_path / 'set' / 'drive.yaml') == Drive()


def test_no_bar_is_drawn_where_nobody_looks(tmp_path, capsys):
    assert made(tmp_path, '--runs', '2') == 0
    told = capsys.readouterr()
    assert told.err == ''
    assert told.out == f'runs: 2, rows in each: 200, seed: 0\ndata set: {tmp_path / "set"}\n'


def test_prescribed_forces_are_driven_once(tmp_path, capsys):
    assert made(tmp_path, '--runs', '3', drive=STEPS) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert 'all of 3 runs would be the same. Leave out --runs' in line
    assert not (tmp_path / 'set').exists()


def test_a_missing_pyarrow_says_what_to_do(tmp_path, capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, 'pyarrow', None)
    monkeypatch.delitem(sys.modules, 'diffbot_sim.tables.parquet', raising=False)
    assert made(tmp_path, '--format', 'parquet') == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert "'pip install pyarrow', or use --format npz" in line
    assert not (tmp_path / 'set').exists()


def test_a_pyarrow_that_does_not_load_says_why(tmp_path, capsys, monkeypatch):
    package = tmp_path / 'packages' / 'pyarrow'
    package.mkdir(parents=True)
    (package / '__init__.py').write_text("raise ImportError('pyarrow requires NumPy 9')")
    monkeypatch.syspath_prepend(package.parent)
    for name in ('pyarrow', 'diffbot_sim.tables.parquet'):
        monkeypatch.delitem(sys.modules, name, raising=False)
    assert made(tmp_path, '--format', 'parquet') == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert 'pyarrow requires NumPy 9' in line


@pytest.mark.parametrize(
    ('words', 'expected'),
    [
        ([], 'one of the arguments BAG --drive is required'),
        (['BAG', '--drive', 'random'], 'not allowed with'),
        (['BAG', '--runs', '3'], 'argument --runs: does not go with BAG'),
        (['BAG', '--seed', '0'], 'argument --seed: does not go with BAG'),
        (['--drive', 'random', '--left-force', 'f'], '--left-force: does not go with --drive'),
        (['--drive', 'random', '--runs', '0'], "'0' is no whole number from 1 on"),
        (['--drive', 'random', '--seed', '-1'], "'-1' is no whole number from 0 on"),
        (['--drive', 'random', '--format', 'csv'], "invalid choice: 'csv'"),
    ],
)
def test_what_does_not_go_together_is_wrong_usage(capsys, words, expected):
    with pytest.raises(SystemExit) as stop:
        main(['simulate', *words, '--params', 'robot.yaml', '--out', 'set'])
    assert stop.value.code == 2
    assert expected in capsys.readouterr().err
