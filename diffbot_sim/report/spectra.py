"""Spectra of the force that is still missing: over time and along the path."""

import numpy as np
from scipy.signal import welch

from diffbot_sim.identification.result import Comparison
from diffbot_sim.records import Array
from diffbot_sim.report.drawing import COLOURS, Figure, axis, layout, line

SEGMENTS = 6  # in a run, overlapping by half
FEWEST = 64


def spectrum_figures(runs: tuple[Comparison, ...]) -> list[Figure]:
    """Draw the spectra of force and torque of the run with most samples."""
    run = max(runs, key=lambda run: len(run.time))
    way = np.concatenate([[0.0], np.cumsum(np.diff(run.time) * np.abs(run.twist[1:, 0]))])
    wanted = (
        ('Rhythm in time', run.time, 'frequency [Hz]', 'N/√Hz', 'N·m/√Hz'),
        ('Rhythm along the path', way, 'cycles per metre', 'N·√m', 'N·m·√m'),
    )
    return [
        _figure(f'{title}, {what}', density(over, run.disturbance[:, column]), x, unit)
        for title, over, x, *units in wanted
        for column, (what, unit) in enumerate(zip(('force', 'torque'), units, strict=True))
    ]


def density(over: Array, values: Array) -> tuple[Array, Array]:
    """Return frequencies and the root of the spectral density there, by Welch's method.

    over: increasing or resting stamps [s] or way [m]; both results are empty where it is short.
    """
    moved = np.concatenate([[True], np.diff(over) > 1e-9])
    over, values = over[moved], values[moved]
    if len(over) < FEWEST:
        return np.empty(0), np.empty(0)
    even = np.linspace(over[0], over[-1], len(over))
    step = float(even[1] - even[0])
    size = 2 * len(even) // (SEGMENTS + 1)
    frequency, power = welch(np.interp(even, over, values), 1.0 / step, nperseg=size)
    return frequency[1:], np.sqrt(power[1:])


def _figure(title: str, curve: tuple[Array, Array], x: str, y: str) -> Figure:
    look = layout(
        250,
        xaxis=axis(x, type='log'),
        yaxis=axis(y, rangemode='tozero'),
        showlegend=False,
        margin={'l': 56, 'r': 8, 't': 10, 'b': 44},
    )
    return Figure(title, '', [line(*curve, 'density', COLOURS['with_effects'])], look)
