"""Drive the model with a bag's forces, or with random or prescribed ones; save the motion."""

from argparse import ArgumentParser, ArgumentTypeError, Namespace
from collections.abc import Callable
from pathlib import Path

import numpy as np

from diffbot_sim.bags import write_trajectory
from diffbot_sim.commands._help import drive_help, effects_help
from diffbot_sim.commands._recordings import (
    MEANING,
    add_topic_options,
    check_out,
    folder,
    read_bags,
)
from diffbot_sim.commands._training import write_training_data
from diffbot_sim.config import load_model
from diffbot_sim.physics import simulate
from diffbot_sim.physics.state import State
from diffbot_sim.records import Odometry
from diffbot_sim.tables import FORMATS

# Options that go with a drive alone.
TRAINING = ('runs', 'seed', 'format')


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the options."""
    source = parser.add_mutually_exclusive_group(required=True)
    source.add_argument(
        'bag', type=Path, nargs='?', metavar='BAG', help='rosbag2 folder, .mcap or .db3'
    )
    source.add_argument(
        '--drive', metavar='random|FILE', help='random forces, or those of a drive file (YAML)'
    )
    parser.add_argument('--params', required=True, metavar='FILE', help='parameter file (YAML)')
    parser.add_argument(
        '--out', type=folder, required=True, metavar='DIR', help='the bag, or the folder of tables'
    )
    add_topic_options(parser)
    training = parser.add_argument_group('with --drive')
    training.add_argument(
        '--runs', type=_at_least(1), metavar='N', help='number of runs (default 1)'
    )
    training.add_argument(
        '--seed', type=_at_least(0), metavar='S', help='of the random forces (default 0)'
    )
    training.add_argument('--format', choices=FORMATS, help='of a table (default npz)')
    parser.set_defaults(refuse=parser.error)
    parser.epilog = f'{drive_help()}\n\n{effects_help()}'


def run(arguments: Namespace) -> None:
    """Predict a bag, or make training data; a stray option is wrong usage."""
    topics = (name.replace('-', '_') for name in MEANING)
    source, strays = ('BAG', TRAINING) if arguments.bag else ('--drive', tuple(topics))
    for name in strays:
        if getattr(arguments, name) is not None:
            arguments.refuse(f'argument --{name.replace("_", "-")}: does not go with {source}')
    if arguments.bag:
        predict(arguments)
    else:
        write_training_data(arguments)


def predict(arguments: Namespace) -> None:
    """Simulate from the recorded first state, at the recorded odometry's stamps."""
    check_out(arguments.out, [arguments.bag])
    model = load_model(arguments.params)
    (recorded,) = read_bags([arguments.bag], arguments)
    measured = recorded.run.odometry
    commands = recorded.run.commands
    predicted = simulate(model, commands, measured.time, first_state(measured))
    write_trajectory(arguments.out, commands, predicted, recorded.start_ns)
    v, omega = np.sqrt(np.mean((predicted.twist - measured.twist) ** 2, axis=0))
    print(f'error over {np.ptp(measured.time):.1f} s, rms: v {v:.4g} m/s, ω {omega:.4g} rad/s')
    print(f'prediction: {arguments.out}')


def first_state(odometry: Odometry) -> State:
    """Return the first measured pose and twist; the origin where no pose was recorded."""
    pose = (0.0, 0.0, 0.0) if odometry.pose is None else odometry.pose[0]
    return State(*map(float, pose), *map(float, odometry.twist[0]))


def _at_least(low: int) -> Callable[[str], int]:
    """Return a reader of whole numbers."""

    def number(text: str) -> int:
        if not text.isdecimal() or int(text) < low:
            raise ArgumentTypeError(f'{text!r} is no whole number from {low} on')
        return int(text)

    return number
