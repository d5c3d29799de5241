"""Drive the model with the recorded forces of a bag; save the motion that it predicts."""

from argparse import ArgumentParser, Namespace
from pathlib import Path

import numpy as np

from diffbot_sim.bags import write_trajectory
from diffbot_sim.commands._recordings import add_topic_options, check_out, read_bags
from diffbot_sim.config import load_model
from diffbot_sim.parameters import Spec
from diffbot_sim.physics import simulate
from diffbot_sim.physics.effects import library
from diffbot_sim.physics.state import State
from diffbot_sim.records import Odometry


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the options."""
    parser.add_argument('bag', type=Path, metavar='BAG', help='rosbag2 folder, .mcap or .db3')
    parser.add_argument('--params', required=True, metavar='FILE', help='parameter file (YAML)')
    parser.add_argument(
        '--out', type=Path, required=True, metavar='DIR', help='the bag with the prediction'
    )
    add_topic_options(parser)
    parser.epilog = effects_help()


def run(arguments: Namespace) -> None:
    """Simulate from the recorded first state, at the recorded odometry's stamps."""
    check_out(arguments.out, [arguments.bag])
    model = load_model(arguments.params)
    (recorded,) = read_bags([arguments.bag], arguments)
    measured = recorded.run.odometry
    predicted = simulate(model, recorded.run.commands, measured.time, first_state(measured))
    write_trajectory(arguments.out, predicted, recorded.start_ns)
    v, omega = np.sqrt(np.mean((predicted.twist - measured.twist) ** 2, axis=0))
    print(f'error over {np.ptp(measured.time):.1f} s, rms: v {v:.4g} m/s, ω {omega:.4g} rad/s')
    print(f'prediction: {arguments.out}')


def first_state(odometry: Odometry) -> State:
    """Return the first measured pose and twist; the origin where no pose was recorded."""
    pose = (0.0, 0.0, 0.0) if odometry.pose is None else odometry.pose[0]
    return State(*map(float, pose), *map(float, odometry.twist[0]))


def effects_help() -> str:
    """List every effect with its parameters."""
    lines = ["effects (keys below 'effects:' in FILE; one that is absent is off):"]
    for name, kind in sorted(library().items()):
        lines += ['', f'  {name}: {kind.meaning}']
        lines += [f'    {_parameter_help(spec)}' for spec in kind.specs()]
    return '\n'.join(lines)


def _parameter_help(spec: Spec) -> str:
    return f'{spec.name}: {spec.meaning}; {spec.valid}, neutral {spec.default:g}'
