"""The whole loop through real processes: drive, record, identify, load back, drive again."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from diffbot_sim.__main__ import main
from diffbot_sim.bags import read_run
from diffbot_sim.commands.demo import NOISE
from diffbot_sim.config import load_model
from diffbot_sim.physics import Model, simulate

# Hides yaw friction. On a slope, what is wrong by chance would grow.
SEED = 3


@pytest.fixture(scope='module')
def told(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Run the demo; the simulator's second drive takes model.yaml by --params-file."""
    out = tmp_path_factory.mktemp('loop') / 'demo'
    assert main(['--seed', str(SEED), '--out', str(out)], 'demo') == 0
    return out


def report_of(out: Path) -> dict[str, Any]:
    report: dict[str, Any] = json.loads((out / 'report' / 'report.json').read_text())
    return report


def speed_error(model: Model, bag: Path) -> float:
    """Return the rms error [m/s] of a model that is given a bag's forces."""
    run = read_run(bag).run
    twist = simulate(model, run.commands, run.odometry.time).twist
    return float(np.sqrt(np.mean((run.odometry.twist - twist)[:, 0] ** 2)))


@pytest.mark.parametrize('bag', ['bag', 'again'])
def test_a_drive_is_recorded_from_its_beginning(told: Path, bag: str) -> None:
    standing = read_run(told / bag).run.odometry.twist[:10]
    assert np.abs(standing).max() < 5.0 * max(NOISE.values())


def test_effect_hidden_in_the_simulator_is_identified_from_its_bag(told: Path) -> None:
    hidden = load_model(told / 'hidden.yaml').effects
    assert [e['name'] for e in report_of(told)['effects']] == [effect.name for effect in hidden]


def test_error_with_the_effect_is_within_a_tenth_of_the_noise_floor(told: Path) -> None:
    errors = report_of(told)['error']
    for norm in ('v_rmse', 'omega_rmse'):
        assert errors['with_effects'][norm] < 1.1 * errors['noise_floor'][norm]


def test_simulator_with_the_identified_model_moves_like_the_hidden_robot(told: Path) -> None:
    hidden, declared = (load_model(told / f'{name}.yaml') for name in ('hidden', 'declared'))
    alike = speed_error(hidden, told / 'again')
    assert alike < 0.006
    assert alike < 0.7 * speed_error(declared, told / 'again')
