"""Where the rest of the EMPS error comes from: the structure, or numbers that do not carry over?

python benchmarks/emps_position.py --data DIR

The benchmark judges position, which integrates every small error of speed. So the structure that
`identify` names is fitted to position, once to each file, and judged on both. Then each number of
the first fit is turned on its own until the test file is met best.
"""

from dataclasses import replace

import numpy as np
from emps import DECLARED, GIVEN, Axis, asked_axes, first_state
from scipy.optimize import brute, least_squares

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
TURNED = ('mass', 'mu_coulomb', 'mu_viscous')  # the axis' own numbers
FURTHEST, TURNS = 0.1, 41  # share by which one is turned either way, and steps of that


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


def missed(model: Model, axis: Axis) -> float:
    """Return the RMSE of the simulated position [mm]."""
    return float(np.sqrt(np.mean(errors(model, axis) ** 2)))


def turned(model: Model, name: str, share: float) -> Model:
    """Return a model of which one number is greater by a share."""
    if name == 'mass':
        return replace(model, robot=replace(model.robot, mass=model.robot.mass * (1.0 + share)))
    value = getattr(model.friction, name) * (1.0 + share)
    return replace(model, friction=replace(model.friction, **{name: value}))


def one_by_one(model: Model, test: Axis) -> str:
    """Turn one number of a model, the others as they are; return Markdown."""
    lines = ['| turned alone | by | test file [mm] |', '|---|---|---|']
    grid = slice(-FURTHEST, FURTHEST, complex(TURNS))
    for name in TURNED:
        share, error, *_ = brute(
            lambda x, name=name: missed(turned(model, name, float(x[0])), test),
            (grid,),
            finish=None,
            full_output=True,
        )
        lines.append(f'| {name} | {100.0 * float(share):+.1f} % | {error:.2f} |')
    return '\n'.join(lines)


def tables(space: Space, train: Axis, test: Axis) -> str:
    """Fit to each file, judge on both; turn what the training file gave. Return Markdown."""
    lines = [
        '| fitted to | training file [mm] | test file [mm] | parameters |',
        '|---|---|---|---|',
    ]
    points = {'training file': fitted(space, train), 'test file': fitted(space, test)}
    for name, point in points.items():
        on_train, on_test = (missed(space.model(point), axis) for axis in (train, test))
        values = {k: v for k, v in space.values(point).items() if k not in IDLE}
        told = ', '.join(f'{key} {value:.3g}' for key, value in values.items())
        lines.append(f'| {name} | {on_train:.2f} | {on_test:.2f} | {told} |')
    return '\n'.join([*lines, '', one_by_one(space.model(points['training file']), test)])


if __name__ == '__main__':
    space = Space(DECLARED, tuple(library()[name] for name in EFFECTS))
    print(tables(space, *asked_axes(__doc__)))
