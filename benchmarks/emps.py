"""EMPS, the friction benchmark: a real axis with a flaw that its makers did not intend.

The axis becomes a robot that drives straight. One file is identified, the other one judges:
its position is simulated from the recorded force alone. Data: Janot, Gautier, Brunot (2019).
"""

import json
import os
import sys
from argparse import ArgumentParser
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy.io import loadmat
from scipy.signal import savgol_filter

from diffbot_sim.__main__ import main as diffbot_sim
from diffbot_sim.bags import write_run
from diffbot_sim.config import load_model, model_from_mapping, model_to_mapping, save_model
from diffbot_sim.errors import DataError, DiffbotError
from diffbot_sim.physics import Friction, Model, Robot, simulate
from diffbot_sim.physics.state import State
from diffbot_sim.records import Array, Commands, Odometry, Run

TRAIN, TEST = 'DATA_EMPS.mat', 'DATA_EMPS_PULSES.mat'
BESIDE = Path(__file__).parents[2] / 'shared' / 'data'
MEASURED = Path(os.environ.get('DIFFBOT_DATA', BESIDE))
WINDOW, ORDER = 15, 3  # of the polynomials that tell speed from position [samples, degree]
EVERY = 10  # samples from one odometry message to the next: 100 Hz
GIVEN = 20  # samples of the test that may tell the initial state: the benchmark's rule
# What one would guess of an axis of this size: 20 N of dry friction, 200 N·s/m of viscous.
DECLARED = Model(
    Robot(mass=100.0, inertia=4.0, wheel_separation=0.4, wheel_radius=0.05),
    Friction('coulomb_viscous', normal_force=500.0, mu_coulomb=0.02, mu_viscous=0.2),
)
PUBLISHED = {
    'LSTM': {'rmse_mm': 74.0},
    'best linear model': {'fit_percent': 25.4},
    'dynoNet': {'rmse_mm': 2.64, 'fit_percent': 96.8},
}

Score = dict[str, float]


@dataclass(frozen=True)
class Axis:
    """A recording at 1 kHz: stamps [s], force of the motor [N], position [m]."""

    name: str
    time: Array
    force: Array
    position: Array


def main() -> int:
    """Run the benchmark; 1 when the data are not there."""
    parser = ArgumentParser(description=__doc__)
    parser.add_argument(
        '--data',
        type=Path,
        default=MEASURED,
        metavar='DIR',
        help=f'folder that holds emps/{TRAIN} and emps/{TEST} '
        '(default: $DIFFBOT_DATA, else ../shared/data)',
    )
    parser.add_argument('--out', type=Path, default=Path('out/emps'), metavar='DIR')
    arguments = parser.parse_args()
    try:
        results = benchmark(arguments.data / 'emps', arguments.out)
    except DiffbotError as problem:
        print('error:', problem, file=sys.stderr)
        return 1
    print(table(results))
    return 0


def benchmark(data: Path, out: Path) -> dict[str, Any]:
    """Convert, identify, judge; write emps.json. Raises DiffbotError."""
    train, test = read_axis(data / TRAIN), read_axis(data / TEST)
    out.mkdir(parents=True, exist_ok=True)
    write_run(out / train.name, as_run(train))
    save_model(DECLARED, out / 'emps.yaml', 'A plain guess of the EMPS axis as a robot.')
    report = identified(out, train.name)
    models = {
        'declared': DECLARED,
        'recalibrated': recalibrated(report['nominal']['parameters']),
        'identified': load_model(out / 'identified' / 'model.yaml'),
    }
    results = {
        'test': {name: score(model, test) for name, model in models.items()},
        'effects': [effect['name'] for effect in report['effects']],
        'published': PUBLISHED,
    }
    (out / 'emps.json').write_text(json.dumps(results, indent=2) + '\n', 'utf-8')
    return results


def asked_axes(description: str) -> tuple[Axis, Axis]:
    """Return both files of the folder that the command line names; exits where one is missing."""
    parser = ArgumentParser(description=description.splitlines()[0])
    parser.add_argument('--data', type=Path, default=MEASURED, metavar='DIR')
    folder = parser.parse_args().data / 'emps'
    try:
        return read_axis(folder / TRAIN), read_axis(folder / TEST)
    except DataError as problem:
        sys.exit(f'error: {problem}')


def read_axis(path: Path) -> Axis:
    """Read one of the benchmark's files; raises DataError where it is missing."""
    if not path.exists():
        raise DataError(
            f'{path}: there is no such file. Get the EMPS data set from nonlinearbenchmark.org, '
            f'put {TRAIN} and {TEST} into DIR/emps and give --data DIR, or set DIFFBOT_DATA=DIR.'
        )
    content = loadmat(path)
    force = float(content['gtau'].item()) * content['vir'].ravel()
    return Axis(path.stem.lower(), content['t'].ravel(), force, content['qm'].ravel())


def as_run(axis: Axis) -> Run:
    """Make a robot's drive of it: half the force on each wheel, never a turn.

    Speed is the slope of a cubic fitted around each sample, so it has no delay.
    """
    period = float(np.mean(np.diff(axis.time)))
    speed = savgol_filter(axis.position, WINDOW, ORDER, deriv=1, delta=period)
    still = np.zeros_like(speed)
    twist = np.column_stack([speed, still])
    pose = np.column_stack([axis.position, still, still])
    odometry = Odometry(axis.time[::EVERY], twist[::EVERY], pose[::EVERY])
    return Run(axis.name, Commands(axis.time, _halves(axis.force)), odometry)


def identified(out: Path, train: str) -> dict[str, Any]:
    """Run the command that everybody uses on the training file alone; return its report."""
    options = ['--params', str(out / 'emps.yaml'), '--out', str(out / 'identified')]
    if diffbot_sim([str(out / train), *options], 'identify'):
        raise DataError('identify failed; its message stands above.')
    report: dict[str, Any] = json.loads((out / 'identified' / 'report.json').read_text('utf-8'))
    return report


def recalibrated(estimates: dict[str, dict[str, Any]]) -> Model:
    """Return the declared model with the values that the report gives."""
    mapping = model_to_mapping(DECLARED)
    values = {name.rpartition('.')[2]: item['value'] for name, item in estimates.items()}
    for section in mapping.values():
        section.update((name, value) for name, value in values.items() if name in section)
    return model_from_mapping(mapping, 'report.json')


def score(model: Model, axis: Axis) -> Score:
    """Simulate the position from the force alone; compare after the given samples."""
    measured = axis.position[GIVEN:]
    error = open_loop(model, axis) - measured
    rmse = float(np.sqrt(np.mean(error**2)))
    return {'rmse_mm': 1e3 * rmse, 'fit_percent': 100.0 * (1.0 - rmse / float(np.std(measured)))}


def open_loop(model: Model, axis: Axis) -> Array:
    """Return the simulated position [m] after the given samples, which tell where it starts."""
    commands = Commands(axis.time, _halves(axis.force))
    return simulate(model, commands, axis.time[GIVEN - 1 :], first_state(axis)).pose[1:, 0]


def first_state(axis: Axis) -> State:
    """Return the state at the last of the samples that may tell it, by a parabola through them."""
    start = np.polyfit(axis.time[:GIVEN] - axis.time[GIVEN - 1], axis.position[:GIVEN], 2)
    return State(x=float(start[2]), v=float(start[1]))


def table(results: dict[str, Any]) -> str:
    """Set our figures beside the published ones."""
    rows = [*results['published'].items(), *results['test'].items()]
    lines = [f'{"open loop, test file":22}{"RMSE [mm]":>12}{"fit [%]":>10}']
    for name, figures in rows:
        cells = (figures.get(key) for key in ('rmse_mm', 'fit_percent'))
        rmse, fit = ('' if cell is None else f'{cell:.4g}' for cell in cells)
        lines.append(f'{name:22}{rmse:>12}{fit:>10}')
    return '\n'.join((*lines, f'effects found: {", ".join(results["effects"]) or "none"}'))


def _halves(force: Array) -> Array:
    return np.column_stack([force, force]) / 2.0


if __name__ == '__main__':
    sys.exit(main())
