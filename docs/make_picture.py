"""Draw docs/demo.svg from the output folder of a demo: motion, models and their errors."""

import json
from argparse import ArgumentParser
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from rosbags.rosbag2 import Reader

from diffbot_sim.bags.messages import STORE
from diffbot_sim.records import Array
from diffbot_sim.report.drawing import COLOURS
from diffbot_sim.report.errors import LABELS, MODELS
from diffbot_sim.report.numerals import significant

SPAN = 12.0  # of the held-out end that is drawn [s]
PAPER, INK, GRID = '#ffffff', '#3c4043', '#e8eaed'
# The dashes of the report, in points.
DASHES = {'declared': (0, (1.0, 1.4)), 'recalibrated': (0, (5.0, 2.0)), 'with_effects': 'solid'}
QUANTITIES = (
    ('v_rmse', 'speed v [m/s]', 'mm/s'),
    ('omega_rmse', 'turn rate ω [rad/s]', 'mrad/s'),
)


def main() -> None:
    """Draw the quantity, v or ω, that recalibration alone leaves further from the noise."""
    parser = ArgumentParser(description=__doc__)
    parser.add_argument('demo', type=Path, help='output folder of a demo')
    parser.add_argument('--out', type=Path, default=Path(__file__).with_name('demo.svg'))
    arguments = parser.parse_args()
    report = json.loads((arguments.demo / 'report' / 'report.json').read_text('utf-8'))
    error = report['error']
    ratios = [error['recalibrated'][key] / error['noise_floor'][key] for key, *_ in QUANTITIES]
    column = int(np.argmax(ratios))
    key, label, unit = QUANTITIES[column]
    series = read_series(arguments.demo / 'report' / 'residual')
    mpl.rcParams.update({'font.size': 15, 'text.color': INK, 'svg.hashsalt': 'diffbot_sim'})
    figure = Figure(figsize=(8.0, 7.2), facecolor=PAPER, layout='constrained')
    upper, lower = figure.subplots(2, 1, height_ratios=(1.5, 1.0))
    draw_motion(upper, series, column, label)
    figure.legend(
        loc='outside upper center', ncols=4, frameon=False, columnspacing=1.2, handlelength=1.6
    )
    draw_errors(lower, {name: 1e3 * error[name][key] for name in LABELS}, unit)
    figure.savefig(arguments.out, dpi=100, metadata={'Date': None, 'Creator': None})


def read_series(bag: Path) -> dict[str, Array]:
    """Return time [s], v [m/s], ω [rad/s], one row each stamp, of what the report compares."""
    wanted = {f'/{name}/twist': name for name in ('measured', *MODELS)}
    rows: dict[str, list[tuple[float, float, float]]] = {name: [] for name in wanted.values()}
    with Reader(bag) as reader:
        sources = [source for source in reader.connections if source.topic in wanted]
        for source, stamp, data in reader.messages(sources):
            twist = STORE.deserialize_cdr(data, source.msgtype).twist
            rows[wanted[source.topic]].append((stamp / 1e9, twist.linear.x, twist.angular.z))
    series = {name: np.array(values) for name, values in rows.items()}
    begin = series['measured'][0, 0]
    return {name: table - (begin, 0.0, 0.0) for name, table in series.items()}


def draw_motion(axes: Axes, series: dict[str, Array], column: int, quantity: str) -> None:
    """Draw one quantity over time, as in the report."""
    for name, table in series.items():
        time, *columns = table[table[:, 0] <= SPAN].T
        look = {'lw': 2.2, 'ls': DASHES.get(name)}
        if name == 'measured':
            look = {'lw': 7.0, 'alpha': 0.3}
        label = LABELS.get(name, name)
        axes.plot(time, columns[column], color=COLOURS[name], label=label, **look)
    axes.set_xlabel('time [s]', color=INK)
    axes.set_ylabel(quantity, color=INK)
    axes.set_xlim(0.0, SPAN)
    tidy(axes)


def draw_errors(axes: Axes, errors: dict[str, float], unit: str) -> None:
    """Draw the errors as bars."""
    names = [LABELS[name] for name in errors]
    bars = axes.barh(names, list(errors.values()), color=[COLOURS[name] for name in errors])
    axes.bar_label(bars, [significant(value) for value in errors.values()], padding=6, color=INK)
    axes.invert_yaxis()
    axes.set_xlabel(f'error of free-running simulation, rms [{unit}]', color=INK)
    axes.set_xlim(0.0, 1.15 * max(errors.values()))
    tidy(axes)


def tidy(axes: Axes) -> None:
    """Leave the data alone on the paper."""
    axes.set_facecolor(PAPER)
    axes.grid(color=GRID)
    axes.set_axisbelow(True)
    axes.tick_params(colors=INK, length=0)
    for spine in axes.spines.values():
        spine.set_visible(False)


if __name__ == '__main__':
    main()
