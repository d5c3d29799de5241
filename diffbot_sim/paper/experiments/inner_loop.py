"""Fig. 13: PI controllers on the wheels' angular velocities, with and without friction."""

import numpy as np
from matplotlib.figure import Figure

from diffbot_sim.control.pi import control
from diffbot_sim.paper.constants import Constants
from diffbot_sim.paper.drawing import over, stacked
from diffbot_sim.paper.experiment import Claim, Experiment, Series
from diffbot_sim.physics import Model, Plant
from diffbot_sim.physics.friction import friction_force
from diffbot_sim.records import Array

TICK, UNTIL = 0.01, 12.0
# From a moment on [s]: references of the right and the left wheel [rad/s].
REFERENCES = ((0.0, 6.0, 6.0), (4.0, 6.0, 4.0), (8.0, 2.0, 4.0))
# The last part of each reference counts as settled [s].
SETTLED = 1.0
# Friction counts as hidden below this share of the largest reference.
HIDDEN = 0.02
TIME, WITH, WITHOUT = 't [s]', 'with friction', 'without friction'
SIDES = ('R', 'L')


def run(constants: Constants) -> Series:
    """Follow the references twice: with friction on the wheels, and without."""
    time = np.linspace(0.0, UNTIL, round(UNTIL / TICK) + 1)
    begins = [begin for begin, *_ in REFERENCES]
    wanted = np.array(REFERENCES)[np.searchsorted(begins, time + 0.5 * TICK) - 1, 1:]
    series = {TIME: time, **_columns('reference', 'ω_{} [rad/s]', wanted)}
    for name, model in ((WITH, constants.model), (WITHOUT, constants.with_friction('none'))):
        speed, force = _follow(constants, model, wanted)
        series |= _columns(name, 'ω_{} [rad/s]', speed) | _columns(name, 'F_{} [N]', force)
    return series


def _follow(constants: Constants, model: Model, wanted: Array) -> tuple[Array, Array]:
    """Return angular speeds [rad/s] and forces [N] at each tick, columns right and left."""
    plant, speed, force = Plant(model), np.zeros(wanted.shape), np.zeros(wanted.shape)
    integrals = [0.0, 0.0]
    for k, references in enumerate(wanted):
        speed[k] = np.array(plant.wheel_speed) / constants.robot.wheel_radius
        for wheel in range(2):
            force[k, wheel], integrals[wheel] = control(
                constants.gains, integrals[wheel], references[wheel], speed[k, wheel], TICK
            )
        plant.step(force[k, 0], force[k, 1], TICK)
    return speed, force


def _columns(what: str, form: str, values: Array) -> dict[str, Array]:
    return {f'{what}: {form.format(side)}': values[:, i] for i, side in enumerate(SIDES)}


def _both(series: Series, what: str, form: str) -> Array:
    return np.column_stack([series[f'{what}: {form.format(side)}'] for side in SIDES])


def draw(series: Series, figure: Figure) -> None:
    """Draw speeds and forces of both wheels."""
    rows = stacked(figure, 4, 1.5)
    for side, speed, force in zip(SIDES, rows[:2], rows[2:], strict=True):
        column, whats = f'ω_{side} [rad/s]', (WITH, WITHOUT, 'reference')
        over(speed, series, TIME, [f'{what}: {column}' for what in whats], column)
        column = f'F_{side} [N]'
        over(force, series, TIME, [f'{what}: {column}' for what in whats[:2]], column)
    for axes in rows:
        axes.legend().remove()
    handles, _ = rows[0].get_legend_handles_labels()
    figure.legend(handles, [WITH, WITHOUT, 'reference'], loc='outside upper center', ncols=3)


def claims(constants: Constants, series: Series) -> tuple[Claim, ...]:
    """Check what is said of the loop: it hides friction from the speed, not from the force."""
    wanted = _both(series, 'reference', 'ω_{} [rad/s]')
    rubbed, free = (_both(series, name, 'ω_{} [rad/s]') for name in (WITH, WITHOUT))
    cost, nothing = (_both(series, name, 'F_{} [N]') for name in (WITH, WITHOUT))
    ends = [begin for begin, *_ in REFERENCES[1:]] + [UNTIL]
    settled = np.zeros(len(wanted), bool)
    for end in ends:
        settled |= (series[TIME] > end - SETTLED) & (series[TIME] < end - 0.5 * TICK)
    most = float(np.abs(wanted).max())
    off, off_free = (float(np.abs(s - wanted)[settled].max()) for s in (rubbed, free))
    v = wanted[settled] * constants.robot.wheel_radius
    demand = friction_force(constants.friction, v, 0.0 * v)
    return (
        Claim(
            'Fig. 13',
            'the inner loop suppresses friction: both robots reach the references',
            f'settled, within {100.0 * off / most:.2f} % with and {100.0 * off_free / most:.2f} % '
            'without friction',
            max(off, off_free) < HIDDEN * most,
        ),
        Claim(
            'Fig. 13',
            'but the forces are realistic: friction costs what the law asks at that speed',
            f'settled, {cost[settled].min():.2f} to {cost[settled].max():.2f} N a wheel with '
            f'friction, at most {np.abs(nothing[settled]).max():.2f} N without',
            bool(
                np.abs(cost[settled] - demand).max() < 0.1 * demand.min()
                and np.abs(nothing[settled]).max() < 0.1 * demand.min()
            ),
        ),
    )


EXPERIMENT = Experiment(
    'fig13',
    'Fig. 13: the inner loop',
    'Wheel speed references (6, 6), then (6, 4), then (2, 4) rad/s for the right and the left '
    'wheel, and one PI controller on each wheel, ticking every 10 ms.',
    run,
    {'fig13': draw},
    claims,
)
