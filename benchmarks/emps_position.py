"""Where the rest of the EMPS error comes from: the structure, or numbers that do not carry over?

python benchmarks/emps_position.py --data DIR

The benchmark judges position, which integrates every small error of speed. So the structure that
`identify` names is fitted to position, once to each file, and judged on both.
"""

import sys
from argparse import ArgumentParser
from pathlib import Path

import numpy as np
from emps import DECLARED, GIVEN, MEASURED, TEST, TRAIN, Axis, first_state, read_axis
from scipy.optimize import least_squares

from diffbot_sim.errors import DiffbotError
from diffbot_sim.identification.fitting.coordinates import Space
from diffbot_sim.physics import Model, simulate
from diffbot_sim.physics.effects import library
from diffbot_sim.physics.embedding import embedded
from diffbot_sim.records import Array, Commands

EFFECTS = ('direction_dependent_friction',)  # what benchmarks/emps.py finds
TOGETHER, EVERY = 5, 10  # samples to a command and from one comparison to the next
STARTS, SPREAD = 4, 0.2  # of fits, since stops and breakaways make the error surface rough
FAR = 5.0  # position errors beyond this count linearly [mm]
# An axis that never turns tells nothing of its inertia.
IDLE = ('inertia',)


def errors(model: Model, axis: Axis) -> Array:
    """Return simulated minus measured position [mm], from the force alone."""
    count = len(axis.force) // TOGETHER * TOGETHER
    force = axis.force[:count].reshape(-1, TOGETHER).mean(axis=1) / 2.0
    commands = Commands(axis.time[:count:TOGETHER], np.column_stack([force, force]))
    seen = np.arange(GIVEN - 1, len(axis.time), EVERY)
    run = simulate(embedded(model), commands, axis.time[seen], first_state(axis))
    return 1e3 * (run.pose[:, 0] - axis.position[seen])


def fitted(space: Space, axis: Axis) -> Array:
    """Return the point at which the simulated position is nearest, of several starts."""
    free = [i for i, c in enumerate(space.coordinates) if c.name not in IDLE]
    low, high = (bound[free] for bound in space.bounds())
    random, points = np.random.default_rng(0), list[tuple[float, Array]]()

    def at(x: Array) -> Array:
        point = space.prior()
        point[free] = x
        return point

    for _ in range(STARTS):
        start = space.prior()[free] + SPREAD * random.normal(size=len(free))
        found = least_squares(
            lambda x: errors(space.model(at(x)), axis),
            np.clip(start, low + 1e-6, high - 1e-6),
            bounds=(low, high),
            x_scale='jac',
            diff_step=1e-3,  # smaller steps see the breakaways instead of the slope
            loss='soft_l1',
            f_scale=FAR,
            max_nfev=30,
        )
        points.append((float(found.cost), at(found.x)))
    return min(points, key=lambda item: item[0])[1]


def table(space: Space, train: Axis, test: Axis) -> str:
    """Fit to each file, judge on both; return Markdown."""
    lines = [
        '| fitted to | training file [mm] | test file [mm] | parameters |',
        '|---|---|---|---|',
    ]
    for name, axis in (('training file', train), ('test file', test)):
        point = fitted(space, axis)
        missed = [np.sqrt(np.mean(errors(space.model(point), a) ** 2)) for a in (train, test)]
        values = {k: v for k, v in space.values(point).items() if k not in IDLE}
        told = ', '.join(f'{key} {value:.3g}' for key, value in values.items())
        lines.append(f'| {name} | {missed[0]:.2f} | {missed[1]:.2f} | {told} |')
    return '\n'.join(lines)


def main() -> int:
    """Print the table; 1 when the data are not there."""
    parser = ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--data', type=Path, default=MEASURED, metavar='DIR')
    folder = parser.parse_args().data / 'emps'
    try:
        train, test = read_axis(folder / TRAIN), read_axis(folder / TEST)
    except DiffbotError as problem:
        print('error:', problem, file=sys.stderr)
        return 1
    print(table(Space(DECLARED, tuple(library()[name] for name in EFFECTS)), train, test))
    return 0


if __name__ == '__main__':
    sys.exit(main())
