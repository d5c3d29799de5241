"""The look of the paper's figures: one style sheet, and the few shapes that they share."""

from collections.abc import Sequence
from importlib.resources import as_file, files
from pathlib import Path

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from diffbot_sim.paper.experiment import Experiment, Series

STYLE = files('diffbot_sim.paper') / 'paper.mplstyle'
# A PNG for the eye, an SVG for print; neither tells when it was made.
FORMATS = {'svg': {'Date': None, 'Creator': None}, 'png': {'Software': None}}


def save_figures(experiment: Experiment, series: Series, out: Path) -> None:
    """Draw every figure of an experiment into a folder, as SVG and as PNG."""
    with as_file(STYLE) as style, mpl.rc_context(fname=style):
        mpl.rcParams['svg.hashsalt'] = experiment.name
        for name, draw in experiment.figures.items():
            figure = Figure(layout='constrained')
            draw(series, figure)
            for kind, metadata in FORMATS.items():
                figure.savefig(out / f'{name}.{kind}', metadata=metadata)


def over(axes: Axes, series: Series, x: str, names: Sequence[str], y: str = '') -> None:
    """Draw columns over another one; y labels the axis, or the only column does.

    Of panels that share x, only the lowest labels it.
    """
    for name in names:
        axes.plot(series[x], series[name], label=name.rpartition(' [')[0])
    axes.set_xlabel(x)
    axes.set_ylabel(y or names[0])
    axes.label_outer()
    if len(names) > 1:
        axes.legend()


def stacked(figure: Figure, rows: int, height: float = 1.9) -> list[Axes]:
    """Return axes one above the other that share x."""
    figure.set_size_inches(figure.get_figwidth(), 0.6 + rows * height)
    return list(figure.subplots(rows, 1, sharex=True, squeeze=False)[:, 0])
