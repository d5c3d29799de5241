"""Drive a robot that hides an effect, find it from the bag, add it, and drive again."""

import json
import shutil
from argparse import ArgumentParser, Namespace
from collections.abc import Mapping
from dataclasses import replace
from itertools import chain
from pathlib import Path
from secrets import randbelow

import numpy as np

from diffbot_sim.__main__ import main
from diffbot_sim.bags import read_run
from diffbot_sim.bags.topics import NAMES
from diffbot_sim.commands._processes import Process, free_domain, stopped_at_end
from diffbot_sim.commands._recordings import folder
from diffbot_sim.config import save_model
from diffbot_sim.errors import DiffbotError
from diffbot_sim.physics import simulate
from diffbot_sim.physics.effects import Effect, sought_effects
from diffbot_sim.physics.model import Model

NOISE = {'linear': 0.004, 'angular': 0.008}  # of the odometry [m/s], [rad/s]
RATE = 50.0  # of the odometry [Hz]
INNER_LOOP = {'lockstep': True, 'enable_stamped_cmd_vel': True}
LEARNING, AGAIN = 100.0, 30.0  # lengths of the drives [s]
# The hidden robot's nominal parameters are off the declared ones by up to this share, and the
# effect has this many typical sizes.
MISCALIBRATION, SIZES = 0.1, (2.0, 5.0)


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the options."""
    parser.add_argument('--out', type=folder, default=Path('out/demo'), metavar='DIR')
    parser.add_argument('--seed', type=int, help='repeats the hidden effect and the drives')


def run(arguments: Namespace) -> None:
    """Tell the story in four steps."""
    out: Path = arguments.out
    seed = randbelow(10_000) if arguments.seed is None else arguments.seed
    _prepare(out)
    declared = Model()
    hidden = hide(declared, seed)
    save_model(declared, out / 'declared.yaml', 'What we believe of the robot.')
    save_model(hidden, out / 'hidden.yaml', 'What the robot is; identify never sees this file.')
    print(f'SEED={seed}: one of {len(hideable())} effects is hidden in the robot.\n')
    print(f'1. Driving it for {LEARNING:g} s of simulation time through ROS 2 ...', flush=True)
    drive(out / 'hidden.yaml', out / 'bag', LEARNING, seed)
    print('2. Learning from the bag what the declared model lacks ...\n', flush=True)
    words = [str(out / 'bag'), '--params', str(out / 'declared.yaml')]
    if main([*words, '--out', str(out / 'report')], 'identify') != 0:
        raise DiffbotError('identify failed; what it said stands above')
    print('\n3. Driving the simulator again, now with the identified model ...', flush=True)
    drive(out / 'report' / 'model.yaml', out / 'again', AGAIN, seed + 1)
    _conclude(out, hidden.effects[0])
    _drive_like_hidden(out, declared, hidden)
    print(f'\nreport: {out / "report" / "report.html"}')


def hide(declared: Model, seed: int) -> Model:
    """Return the robot that is driven: miscalibrated, with one effect that nobody declared."""
    random = np.random.default_rng(seed)
    kinds = hideable()
    effect = _some(kinds[random.integers(len(kinds))], random)
    off = 1.0 + MISCALIBRATION * random.uniform(-1.0, 1.0, 4)
    robot = replace(
        declared.robot,
        mass=declared.robot.mass * off[0],
        inertia=declared.robot.inertia * off[1],
    )
    friction = replace(
        declared.friction,
        mu_coulomb=declared.friction.mu_coulomb * off[2],
        mu_viscous=declared.friction.mu_viscous * off[3],
    )
    return Model(robot, friction, (effect,))


def drive(params: Path, bag: Path, duration: float, seed: int) -> None:
    """Run simulator, inner loop, recorder and driver as processes until the drive is over.

    In lockstep, so that a seed gives the same drive again, however busy the machine is.
    """
    logs = bag.parent / 'logs' / bag.name
    logs.mkdir(parents=True, exist_ok=True)
    domain = free_domain()
    options = {
        'lockstep': True,
        'publish_rate': RATE,
        'odometry_noise.seed': seed,
        **{f'odometry_noise.{name}': value for name, value in NOISE.items()},
    }
    with stopped_at_end() as running:

        def start(node: str, text: str, *words: str) -> Process:
            running.append(Process(node, words, logs / f'{node}.log', domain))
            running[-1].wait_for(text)
            return running[-1]

        file = ('--ros-args', '--params-file', str(params))
        start('simulator', 'ready', *file, *_set(options))
        start('pi_controller', 'ready', *file, *_set(INNER_LOOP))
        recorder = start('recorder', 'recording', '--output', str(bag))
        for topic in chain(*NAMES.values()):
            # Nodes may find each other late: then the drive's begin is lost.
            recorder.wait_for(f'found {topic}\n')
        words = _set({'duration': duration, 'seed': seed, 'stamped': True})
        driver = start('driver', 'driving', '--ros-args', *words)
        driver.wait(10.0 * duration)


def _prepare(out: Path) -> None:
    """Make the folder; what an earlier demo left there makes room."""
    if (out / 'hidden.yaml').exists():
        for name in ('bag', 'again', 'logs', 'report'):
            shutil.rmtree(out / name, ignore_errors=True)
    elif out.exists() and any(out.iterdir()):
        raise DiffbotError(f'{out}: is not empty and holds no earlier demo. Choose another OUT.')
    out.mkdir(parents=True, exist_ok=True)


def hideable() -> list[type[Effect]]:
    """Return the effects whose sizes can be drawn one by one: no moments, periods and limits."""
    return [
        kind
        for kind in sought_effects().values()
        if not kind.shape and not any(spec.reciprocal for spec in kind.specs())
    ]


def _some(kind: type[Effect], random: np.random.Generator) -> Effect:
    """Return an effect of random, ample size."""
    values = {}
    for spec in kind.specs():
        sign = random.choice([-1.0, 1.0]) if spec.low < spec.default else 1.0
        value = spec.default + sign * spec.scale * random.uniform(*SIZES)
        values[spec.name] = float(np.clip(value, spec.low, spec.high))
    return kind(**values)


def _set(options: Mapping[str, float]) -> list[str]:
    words = {key: str(value).lower() for key, value in options.items()}
    return [word for key, value in words.items() for word in ('-p', f'{key}:={value}')]


def _conclude(out: Path, hidden: Effect) -> None:
    """Hold what was found against what was hidden, and the drives against each other."""
    report = json.loads((out / 'report' / 'report.json').read_text())
    found = {item['name']: item for item in report['effects']}
    print('\n4. What was hidden, and what was found')
    for spec in hidden.specs():
        estimate = found.get(hidden.name, {'parameters': {}})['parameters'].get(spec.name)
        low, high = estimate['ci95'] if estimate else (float('nan'), float('nan'))
        value = f'{estimate["value"]:.4g} [{low:.4g}, {high:.4g}]' if estimate else 'not found'
        true = f'{getattr(hidden, spec.name):.4g}'
        print(f'   {hidden.name}.{spec.name}: hidden {true}, found {value} {spec.unit_text}')
    for name in found.keys() - {hidden.name}:
        print(f'   {name}: found, but was not hidden')


def _drive_like_hidden(out: Path, declared: Model, hidden: Model) -> None:
    """Tell whether the simulator with the identified model moves like the hidden robot."""
    run = read_run(out / 'again').run
    print('   The second drive, and what its forces predict (rms difference):')
    for name, model in (('of the hidden robot', hidden), ('of the declared model', declared)):
        twist = simulate(model, run.commands, run.odometry.time).twist
        v, omega = 1e3 * np.sqrt(np.mean((run.odometry.twist - twist) ** 2, axis=0))
        print(f'   {name}: {v:.2f} mm/s and {omega:.2f} mrad/s')
    v, omega = (1e3 * NOISE[name] for name in ('linear', 'angular'))
    print(f'   (odometry noise alone: {v:.2f} mm/s and {omega:.2f} mrad/s)')
