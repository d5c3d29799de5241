"""Real data: the EMPS benchmark, identified without a hint."""

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).parents[1]
DATA = Path(os.environ.get('DIFFBOT_DATA', ROOT.parent / 'shared' / 'data'))

needs_data = pytest.mark.skipif(
    not (DATA / 'emps').is_dir(),
    reason='no EMPS data: see benchmarks/README.md and set DIFFBOT_DATA to the folder over emps/',
)


def benchmark(data: Path, out: Path) -> subprocess.CompletedProcess[str]:
    return run('emps.py', '--data', str(data), '--out', str(out))


def run(script: str, *arguments: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, str(ROOT / 'benchmarks' / script), *arguments]
    environment = os.environ | {'PYTHONPATH': str(ROOT)}
    return subprocess.run(command, capture_output=True, text=True, check=False, env=environment)


@pytest.fixture(scope='module')
def results(tmp_path_factory: pytest.TempPathFactory) -> Any:
    out = tmp_path_factory.mktemp('emps')
    done = benchmark(DATA, out)
    assert done.returncode == 0, done.stderr
    return json.loads((out / 'emps.json').read_text('utf-8'))


@needs_data
def test_the_worn_screw_is_found(results: Any) -> None:
    assert 'direction_dependent_friction' in results['effects']


@needs_data
def test_position_simulated_from_the_force_alone_comes_much_nearer(results: Any) -> None:
    before, after = results['test']['recalibrated'], results['test']['identified']
    assert after['rmse_mm'] < 0.2 * before['rmse_mm']


@needs_data
def test_the_axis_rubs_more_in_the_file_that_judges() -> None:
    done = run('emps_force.py', '--data', str(DATA))
    assert done.returncode == 0, done.stderr
    rows = (line.split('|') for line in done.stdout.splitlines())
    viscous = [row[2:4] for row in rows if 'viscous' in row[1]]
    assert len(viscous) == 2
    assert all(1.03 < float(test) / float(train) < 1.05 for train, test in viscous)


def test_missing_data_are_told_with_the_way_to_get_them(tmp_path: Path) -> None:
    done = benchmark(tmp_path / 'nowhere', tmp_path / 'out')
    assert done.returncode == 1
    assert 'nonlinearbenchmark.org' in done.stderr
    assert len(done.stderr.splitlines()) == 1
