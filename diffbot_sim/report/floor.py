"""A map of the floor: where on it something acts that no effect accounts for."""

import numpy as np

from diffbot_sim.identification.result import Comparison, Identification, Structure
from diffbot_sim.records import Array
from diffbot_sim.report.drawing import COLOURS, Figure, Json, axis, column, layout, line, thinned

# Colours are the strongest beyond this quantile of the forces.
STRONGEST = 0.98
# What a positive force does.
FORWARD, OUTWARD = 'in the sense of the motion', 'away from the middle'


def floor_figures(result: Identification) -> list[Figure]:
    """Draw the way over the floor, in colours of the force that the model lacks.

    None where what is left depends on no spot of the floor, or no pose was recorded.
    """
    left = result.unexplained
    runs = [run for run in result.comparisons if run.pose is not None]
    if left is None or left.spot is None or not runs:
        return []
    place = np.concatenate([run.pose for run in runs if run.pose is not None])[:, :2]
    force = np.concatenate([_sense(run, left) * run.disturbance[:, 0] for run in runs])
    note = (
        f'The force that the model lacks, as estimated on held-out data, {_meaning(left)}; '
        'the circle is the spot on which it depends.'
    )
    x_axis = axis('x [m]', constrain='domain')
    y_axis = axis('y [m]', constrain='domain', scaleanchor='x', scaleratio=1)
    look = layout(460, xaxis=x_axis, yaxis=y_axis, hovermode='closest', showlegend=False)
    data = [_way(place, force), _circle(left.spot)]
    return [Figure('Where on the floor it acts', note, data, look)]


def _meaning(left: Structure) -> str:
    return OUTWARD if left.variable == 'round_hill' else FORWARD


def _sense(run: Comparison, left: Structure) -> Array:
    """Return 1 where a force along the robot has the sense that is drawn, else -1."""
    if _meaning(left) == FORWARD or left.spot is None or run.pose is None:
        return np.sign(run.twist[:, 0])
    x, y = (run.pose[:, :2] - left.spot[:2]).T
    return np.asarray(np.sign(x * np.cos(run.pose[:, 2]) + y * np.sin(run.pose[:, 2])))


def _way(place: Array, force: Array) -> Json:
    rows = thinned(len(place))
    # Where a run has gaps no force is known.
    most = float(np.nanquantile(np.abs(force), STRONGEST))
    bar = {'title': {'text': 'force [N]', 'side': 'right'}, 'thickness': 12}
    scale = {'colorscale': 'RdBu', 'cmin': -most, 'cmax': most, 'colorbar': bar}
    dots = {'color': column(force[rows]), 'size': 5, **scale}
    places = {'x': column(place[rows, 0]), 'y': column(place[rows, 1])}
    return {'type': 'scatter', 'mode': 'markers', 'marker': dots, **places}


def _circle(spot: Array) -> Json:
    angle = np.linspace(0.0, 2.0 * np.pi, 73)
    x, y, radius = spot
    around = x + radius * np.cos(angle), y + radius * np.sin(angle)
    return line(*around, 'the spot', COLOURS['measured'], dash='dash', hoverinfo='skip')
