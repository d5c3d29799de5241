"""A map of the floor: where on it something acts that no effect accounts for."""

import numpy as np

from diffbot_sim.identification.result import ROUND_HILL, Comparison, Identification
from diffbot_sim.records import Array
from diffbot_sim.report.drawing import COLOURS, Figure, Json, column, line, plane, thinned

# Colours are the strongest beyond this quantile of the forces.
STRONGEST = 0.98


def floor_figures(result: Identification) -> list[Figure]:
    """Draw the way over the floor, in colours of the force that the model lacks.

    None where what is left depends on no spot of the floor, or no pose was recorded.
    """
    left = result.unexplained
    seen = [(run, run.pose) for run in result.comparisons if run.pose is not None]
    if left is None or left.spot is None or not seen:
        return []
    if left.variable == ROUND_HILL:
        meaning, senses = 'away from the middle', [_outward(pose, left.spot) for _, pose in seen]
    else:
        meaning, senses = 'in the sense of the motion', [_forward(run) for run, _ in seen]
    place = np.concatenate([pose[:, :2] for _, pose in seen])
    force = np.concatenate(senses) * np.concatenate([run.disturbance[:, 0] for run, _ in seen])
    note = (
        f'The force that the model lacks, as estimated on held-out data, {meaning}; '
        'the circle is the spot on which it depends.'
    )
    data = [_way(place, force), _circle(left.spot)]
    return [Figure('Where on the floor it acts', note, data, plane(460, showlegend=False))]


def _forward(run: Comparison) -> Array:
    """Return 1 where the robot drives forward, -1 where it drives backward."""
    return np.sign(run.twist[:, 0])


def _outward(pose: Array, spot: Array) -> Array:
    """Return 1 where the robot faces away from the middle of a spot, -1 where towards it."""
    x, y = (pose[:, :2] - spot[:2]).T
    return np.asarray(np.sign(x * np.cos(pose[:, 2]) + y * np.sin(pose[:, 2])))


def _way(place: Array, force: Array) -> Json:
    rows = thinned(len(place))
    most = float(np.quantile(np.abs(force), STRONGEST))
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
