"""How exact integrators of wheel friction are, ours beside those that others use.

python benchmarks/accuracy.py                          print the tables
python benchmarks/accuracy.py --out docs/numerics.md   remake them where they are published
"""

from argparse import ArgumentParser
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from timeit import timeit

import mujoco_frictionloss
import numpy as np
import other_integrators as other
from stick_slip import COULOMB_VISCOUS, EVERY, GENERALIZED, Course, rolling, stick_slip

from diffbot_sim.physics import Model, simulate
from diffbot_sim.records import Array, Commands

# Model, forces [N] (n, 2), how long each is held [s], step [s] -> x, y, travel of the wheels [m].
Method = Callable[[Model, Array, float, float], Array]

STEPS = np.array([0.02, 0.01, 0.005, 0.002, 0.001])  # [s]
STEP = 0.01  # of the drifts and the cost [s]
KNOWN = 1e-11  # the reference itself is no surer than this [m]; smaller errors tell no order
# Forces on the right and left wheel in F_s, and how long they act [s]: the left one must hold.
HOLDS = ((0.9, 0.9, 100), (0.99, 0.99, 1000), (1.5, 0.99, 1000))
HOLD_HEADS = ('100 s at 0.9 F_s', '1000 s at 0.99 F_s', 'the same, right wheel slides')
UNITS = {'m': 1.0, 'mm': 1e-3, 'µm': 1e-6, 'nm': 1e-9, 'pm': 1e-12}
BEGIN, END = '<!-- made by benchmarks/accuracy.py -->\n', '<!-- end -->\n'


def ours(model: Model, forces: Array, interval: float, step: float) -> Array:
    """Simulate as everything else in this repository does."""
    times = np.arange(len(forces) + 1) * interval
    run = simulate(model, Commands(times[:-1], forces), times, max_step=step)
    return np.column_stack([run.pose[:, :2], run.wheel_angle * model.robot.wheel_radius])


BACKWARD_EULER = partial(other.drive, other.backward_euler_step, 0.0)
FOR_GENERALIZED: dict[str, Method] = {
    'ours': ours,
    'set-valued backward Euler': BACKWARD_EULER,
    'Karnopp band 1e-3 m/s': partial(other.drive, other.karnopp_step, 1e-3),
    'tanh, 1e-3 m/s': partial(other.drive, other.tanh_step, 1e-3),
    'tanh, 1e-2 m/s': partial(other.drive, other.tanh_step, 1e-2),
}
FOR_COULOMB: dict[str, Method] = {
    'ours': ours,
    'set-valued backward Euler': BACKWARD_EULER,
    'MuJoCo frictionloss, stiff': partial(mujoco_frictionloss.drive, True),
    'MuJoCo frictionloss, default': partial(mujoco_frictionloss.drive, False),
}
LAWS = {
    'Friction (13)': (GENERALIZED, FOR_GENERALIZED),
    'Coulomb and viscous friction, as MuJoCo has it': (COULOMB_VISCOUS, FOR_COULOMB),
}


def main() -> None:
    """Measure, print, and put the tables between the marks of a file."""
    parser = ArgumentParser(description=__doc__.partition('\n')[0] if __doc__ else None)
    parser.add_argument('--out', type=Path, metavar='FILE', help='Markdown with the marks in it')
    out = parser.parse_args().out
    if out and BEGIN not in out.read_text('utf-8'):
        parser.error(f'{out} has no line {BEGIN.strip()}, below which the tables could go.')
    tables = '\n'.join(line for law in LAWS for line in report(law))
    print(tables)
    if out:
        out.write_text(remade(out.read_text('utf-8'), tables), 'utf-8')


def remade(text: str, tables: str) -> str:
    """Return the text with what stands between the marks replaced."""
    (before, rest), tables = text.split(BEGIN), f'\n{tables}\n'
    return before + BEGIN + tables + END + rest.split(END)[1]


def report(law: str) -> Iterator[str]:
    """Write a law's two tables."""
    model, methods = LAWS[law]
    heads = (f'{1e3 * step:g} ms' for step in STEPS)
    yield f'**{law}.** Largest position error over 60 s, {stick_slip(model).events} events:\n'
    yield from table((*heads, 'order', 'order, no events', 'cost'), errors(model, methods))
    yield '\nTravel of the left wheel, which should hold, at a 10 ms step:\n'
    yield from table(HOLD_HEADS, drifts(model, methods))
    yield ''


def table(heads: tuple[str, ...], rows: dict[str, list[str]]) -> Iterator[str]:
    """Write a Markdown table."""
    yield f'| method | {" | ".join(heads)} |'
    yield '|---|' + '--:|' * len(heads)
    for name, cells in rows.items():
        yield f'| {name} | {" | ".join(cells)} |'


def errors(model: Model, methods: dict[str, Method]) -> dict[str, list[str]]:
    """Return each method's errors by step, orders, and cost as a multiple of ours."""
    rows = {}
    for (name, method), cost in zip(methods.items(), costs(model, methods), strict=True):
        slips, rolls = (
            np.array([error(method, model, course, step) for step in STEPS])
            for course in (stick_slip(model), rolling(model))
        )
        orders = [f'{round(order(each), 1) + 0.0}' for each in (slips, rolls)]
        rows[name] = [*map(length, slips), *orders, f'{cost:.1g}']
    return rows


def error(method: Method, model: Model, course: Course, step: float) -> float:
    """Return the largest distance from the reference [m]."""
    positions = method(model, course.forces, EVERY, step)[:, :2]
    return float(np.hypot(*(positions - course.rows[:, :2]).T).max())


def order(errors: Array) -> float:
    """Return the slope of the errors over the step, both logarithmic."""
    known = errors > KNOWN
    return float(np.polyfit(np.log(STEPS[known]), np.log(errors[known]), 1)[0])


def costs(model: Model, methods: dict[str, Method]) -> Array:
    """Return the time that 60 s of stick-slip take, as multiples of ours; ours is the first.

    Best of many rounds through all methods, so that other work on the machine slows all alike.
    """
    forces = stick_slip(model).forces
    runs = [partial(method, model, forces, EVERY, STEP) for method in methods.values()]
    rounds = [[timeit(run, number=1) for run in runs] for _ in range(30)]
    best = np.min(rounds, axis=0)
    return np.asarray(best / best[0])


def drifts(model: Model, methods: dict[str, Method]) -> dict[str, list[str]]:
    """Return how far each method lets the left wheel roll [m] where it must not."""
    law, rows = model.friction.law(), {}
    for name, method in methods.items():
        forces = [np.tile([right, left], (time, 1)) for right, left, time in HOLDS]
        runs = (method(model, (law.coulomb + law.excess) * each, 1.0, STEP) for each in forces)
        rows[name] = [length(float(np.abs(run[:, 3]).max())) for run in runs]
    return rows


def length(metres: float) -> str:
    """Write a length with two digits, in the largest unit that fits."""
    if 0.0 < metres < 1e-12:
        return '< 1 pm'
    unit, size = next(each for each in UNITS.items() if metres >= each[1] or not metres)
    return f'{float(f"{metres / size:.2g}"):g} {unit}'


if __name__ == '__main__':
    main()
