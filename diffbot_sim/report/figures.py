"""The figures: what was measured, what each model says, and what is left."""

from typing import Any

import numpy as np

from diffbot_sim.identification.result import Comparison, Errors, Identification, Structure
from diffbot_sim.records import Array, Trajectory
from diffbot_sim.report.dependence import (
    VARIABLES,
    Curve,
    binned,
    pooled,
    residual,
    strongest,
)
from diffbot_sim.report.drawing import (
    COLOURS,
    DASHES,
    Figure,
    Json,
    axis,
    band,
    layout,
    line,
    plane,
    stacked,
)
from diffbot_sim.report.errors import LABELS, error_rows, models_shown
from diffbot_sim.report.numerals import significant

SMALL = 250
# Residuals are drawn against so many variables.
SHOWN = 3
FORCE, TORQUE = 'force [N]', 'torque [N·m]'
# Marks of a logarithmic axis [s].
SECONDS = (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100)


def run_figures(result: Identification, run: Comparison) -> list[Figure]:
    """Draw one held-out stretch: motion, residuals, path where a pose was recorded."""
    models = models_shown(result)
    figures = [_motion(run, models), _residuals(run, models)]
    return figures if run.pose is None else [*figures, _path(run, run.pose, models)]


def _motion(run: Comparison, models: tuple[str, ...]) -> Figure:
    # Wide and pale, so that it shows beneath a model that fits.
    data = _pair('measured', run.time, run.twist, 1.0, width=4.0, dash='solid', opacity=0.4)
    for model in models:
        trajectory: Trajectory = getattr(run, model)
        data += _pair(model, run.time, trajectory.twist, 1.0, dash=DASHES[model])
    note = 'Free-running simulation, driven by the recorded forces alone. Drag to zoom.'
    labels = ('v [m/s]', 'ω [rad/s]')
    return Figure('Measured and simulated motion', note, data, stacked(460, 'time [s]', *labels))


def _residuals(run: Comparison, models: tuple[str, ...]) -> Figure:
    data: list[Json] = []
    for model in models:
        left = np.column_stack([residual(run, model, 0), residual(run, model, 1)])
        # A declared model far off would flatten the two that matter; a tap on it shows it.
        shown = True if model in models[-2:] else 'legendonly'
        data += _pair(model, run.time, left, 1e3, width=1.0, visible=shown)
    note = 'Measured minus simulated. White noise around zero is all that should remain.'
    labels = ('v [mm/s]', 'ω [mrad/s]')
    return Figure('Residual over time', note, data, stacked(400, 'time [s]', *labels))


def _pair(key: str, time: Array, twist: Array, scale: float, **look: Any) -> list[Json]:
    """Draw v above ω with one entry in the legend."""
    panels: tuple[Json, Json] = {'yaxis': 'y'}, {'yaxis': 'y2', 'showlegend': False}
    name, colour = _label(key), COLOURS[key]
    return [
        line(time, scale * twist[:, k], name, colour, legendgroup=key, **panels[k], **look)
        for k in range(2)
    ]


def _path(run: Comparison, pose: Array, models: tuple[str, ...]) -> Figure:
    colour = COLOURS['measured']
    data = [line(pose[:, 0], pose[:, 1], 'measured', colour, width=4.0, opacity=0.4)]
    for model in models:
        x, y, _ = getattr(run, model).pose.T
        data.append(line(x, y, _label(model), COLOURS[model], dash=DASHES[model]))
    return Figure('Path in the plane', 'All start from the measured pose.', data, plane(460))


def residual_figures(result: Identification) -> list[Figure]:
    """Draw the residuals before and after against the variables that explain most of them."""
    models = models_shown(result)[-2:]
    return [
        _dependence(result.comparisons, models, axis_, name)
        for axis_ in range(2)
        for name in strongest(result.comparisons, models[0], axis_)[:SHOWN]
    ]


def _dependence(
    runs: tuple[Comparison, ...], models: tuple[str, ...], axis_: int, name: str
) -> Figure:
    x = pooled(runs, VARIABLES[name].of)
    data: list[Json] = []
    shares = []
    for model in models:
        curve = binned(x, 1e3 * np.concatenate([residual(run, model, axis_) for run in runs]))
        data += _curve(curve, _label(model), COLOURS[model])
        shares.append(f'{_percent(curve)} {_label(model)}')
    title = f'{("v", "ω")[axis_]} against {_short(name)}'
    unit = ('v residual [mm/s]', 'ω residual [mrad/s]')[axis_]
    return Figure(title, f'Explains {", ".join(shares)}', data, _small(name, unit))


def disturbance_figures(result: Identification) -> list[Figure]:
    """Draw the force and the torque that the identified model still lacks."""
    wanted = ((0, 'v'), (0, 'heading'), (1, 'omega'), (1, 'heading'))
    return [_disturbance(result.comparisons, axis_, name) for axis_, name in wanted]


def _disturbance(runs: tuple[Comparison, ...], axis_: int, name: str) -> Figure:
    x = pooled(runs, VARIABLES[name].of)
    curve = binned(x, pooled(runs, lambda run: run.disturbance[:, axis_]))
    what = ('Force', 'Torque')[axis_]
    data = _curve(curve, what.lower(), COLOURS['with_effects'])
    look = _small(name, (FORCE, TORQUE)[axis_])
    return Figure(f'{what} against {_short(name)}', f'Explains {_percent(curve)}', data, look)


def structure_figure(structure: Structure) -> Figure:
    """Draw the empirical curve of what no effect accounts for."""
    spread = 1.96 * structure.force_error
    (x, xaxis), y = _on_paper(structure), structure.force
    colour = COLOURS['with_effects']
    data = [band(x, y - spread, y + spread, colour), line(x, y, 'estimate', colour)]
    force = TORQUE if structure.axis == 'omega' else FORCE
    look = layout(320, xaxis=xaxis, yaxis=axis(force), showlegend=False)
    about = (
        'Estimate with its 95 % band, beside the friction and inertia that were fitted with it.'
    )
    title = f'What no effect accounts for {structure.part}'
    return Figure(title.rstrip(), about, data, look)


def _on_paper(structure: Structure) -> tuple[Array, Json]:
    """Return the knots of a curve, and their axis, as people read them: in degrees, in seconds."""
    label, knots = structure.over, structure.knots
    if label.endswith('[rad]'):
        return np.degrees(knots), axis(label.replace('rad', '°'))
    if label.endswith('[ln s]'):
        return np.exp(knots), axis(label.replace('ln s', 's'), type='log', tickvals=SECONDS)
    return knots, axis(label)


def error_figures(errors: Errors) -> list[Figure]:
    """Draw the four errors as bars, for v and for ω."""
    rows = error_rows(errors)[::-1]
    series = (('v', 'mm/s', [r.v for r in rows]), ('ω', 'mrad/s', [r.omega for r in rows]))
    labels, colours = [r.label for r in rows], [COLOURS[r.key] for r in rows]
    return [
        Figure(
            f'Held-out error in {name}', '', [_bars(labels, sizes, colours)], _bar_look(unit, 190)
        )
        for name, unit, sizes in series
    ]


def candidates_figure(result: Identification) -> Figure:
    """Draw how much each candidate would improve the model, best on top."""
    rows = result.candidates[::-1]
    found = {effect.name for effect in result.effects}
    colours = [COLOURS['with_effects' if row.name in found else 'noise_floor'] for row in rows]
    bars = _bars([row.name for row in rows], [row.score for row in rows], colours)
    note = 'Fall of the BIC when the effect is added, no bar where it rises; blue was added.'
    look = _bar_look('fall of the BIC', 70 + 26 * len(rows))
    return Figure('Candidates ranked', note, [bars], look)


def _bars(labels: list[str], sizes: list[float], colours: list[str]) -> Json:
    lengths = [max(size, 0.0) if np.isfinite(size) else 0.0 for size in sizes]
    words = [significant(size) for size in sizes]
    text = {'text': words, 'textposition': 'outside', 'cliponaxis': False, 'hoverinfo': 'skip'}
    places = {'x': lengths, 'y': labels, 'marker': {'color': colours}}
    return {'type': 'bar', 'orientation': 'h', **places, **text}


def _bar_look(unit: str, height: int) -> Json:
    room = {'l': 8, 'r': 56, 't': 8, 'b': 44}
    names = {'automargin': True, 'ticksuffix': ' ', 'type': 'category'}
    ticks = axis(unit, nticks=4, tickangle=0)
    return layout(height, xaxis=ticks, yaxis=names, margin=room, bargap=0.3, hovermode=False)


def _curve(curve: Curve, name: str, colour: str) -> list[Json]:
    return [
        band(curve.x, curve.low, curve.high, colour),
        line(curve.x, curve.middle, name, colour, mode='lines+markers', marker={'size': 4}),
    ]


def _small(name: str, y: str) -> Json:
    axes = {'xaxis': axis(VARIABLES[name].label), 'yaxis': axis(y)}
    return layout(SMALL, **axes, showlegend=False, margin={'l': 56, 'r': 8, 't': 10, 'b': 44})


def _short(name: str) -> str:
    return VARIABLES[name].label.split(' [')[0]


def _percent(curve: Curve) -> str:
    return f'{100 * curve.explained:.0f} %'


def _label(key: str) -> str:
    return LABELS.get(key, key)
