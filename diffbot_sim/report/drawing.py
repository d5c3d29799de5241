"""The pieces of figures: plain data for plotly.js, in colours that the colour-blind tell apart."""

from base64 import b64encode
from dataclasses import dataclass
from html import escape
from typing import Any

import numpy as np

from diffbot_sim.records import Array

Json = dict[str, Any]

# Okabe and Ito's palette; a model keeps its colour in every figure and table.
COLOURS = {
    'measured': '#222222',
    'declared': '#cc79a7',
    'recalibrated': '#e69f00',
    'with_effects': '#0072b2',
    'noise_floor': '#8c8c8c',
}
DASHES = {'declared': 'dot', 'recalibrated': 'dash', 'with_effects': 'solid'}
POINTS = 4000
GRID = '#e8eaed'


@dataclass(frozen=True)
class Figure:
    """A figure: a title, a line that says how to read it, and what plotly.js draws."""

    title: str
    note: str
    data: list[Json]
    layout: Json


def column(values: Array) -> Json:
    """Encode numbers compactly; plotly.js leaves gaps where they are not finite."""
    coded = b64encode(np.ascontiguousarray(values, dtype='<f8').tobytes())
    return {'dtype': 'f8', 'bdata': coded.decode('ascii')}


def thinned(count: int) -> Array:
    """Choose at most POINTS rows; the same for all traces, so that hovering compares them."""
    return np.unique(np.linspace(0, count - 1, min(count, POINTS)).astype(int))


def line(
    x: Array,
    y: Array,
    name: str,
    colour: str,
    width: float = 1.6,
    dash: str = 'solid',
    **more: Any,
) -> Json:
    """Draw y over x as a line."""
    pen = {'color': colour, 'width': width, 'dash': dash}
    rows = thinned(len(x))
    look = {'type': 'scatter', 'mode': 'lines', 'name': escape(name), 'line': pen}
    return {**look, 'x': column(x[rows]), 'y': column(y[rows]), **more}


def band(x: Array, low: Array, high: Array, colour: str) -> Json:
    """Shade between two curves over the same x."""
    around = np.concatenate([x, x[::-1]]), np.concatenate([high, low[::-1]])
    style = {'fill': 'toself', 'fillcolor': colour + '26', 'line': {'width': 0}}
    quiet = {'hoverinfo': 'skip', 'showlegend': False}
    places = {'x': column(around[0]), 'y': column(around[1])}
    return {'type': 'scatter', 'mode': 'lines', **style, **quiet, **places}


def axis(title: str, **more: Any) -> Json:
    """Describe an axis."""
    label = {'text': escape(title), 'standoff': 8}
    lines = {'gridcolor': GRID, 'zerolinecolor': '#c4c8cc', 'linecolor': '#c4c8cc'}
    return {'title': label, 'automargin': True, **lines, **more}


def layout(height: int, **more: Any) -> Json:
    """Return what all figures share: font, margins, the legend below."""
    return {
        'height': height,
        'font': {'family': 'system-ui, sans-serif', 'size': 12, 'color': '#3c4043'},
        'margin': {'l': 56, 'r': 12, 't': 30, 'b': 44},
        'paper_bgcolor': 'rgba(0,0,0,0)',
        'plot_bgcolor': 'rgba(0,0,0,0)',
        'legend': {'orientation': 'h', 'yref': 'container', 'y': 0, 'yanchor': 'bottom'},
        'hovermode': 'x unified',
        'modebar': {'bgcolor': 'rgba(0,0,0,0)', 'color': '#b0b4b8', 'activecolor': '#3c4043'},
        **more,
    }


def stacked(height: int, x: str, upper: str, lower: str) -> Json:
    """Return the layout of two panels that share and zoom their x axis."""
    return layout(
        height,
        xaxis=axis(x, anchor='y2'),
        yaxis=axis(upper, domain=[0.53, 1.0]),
        yaxis2=axis(lower, domain=[0.0, 0.47]),
    )


def plane(height: int, **more: Any) -> Json:
    """Return the layout of a map, of one scale along x and y."""
    x_axis = axis('x [m]', constrain='domain')
    y_axis = axis('y [m]', constrain='domain', scaleanchor='x', scaleratio=1)
    return layout(height, xaxis=x_axis, yaxis=y_axis, hovermode='closest', **more)
