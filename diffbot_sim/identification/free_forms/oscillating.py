"""A force that comes and goes at a rate of its own, whatever the robot does.

A drum out of balance, an engine, an arm at work. Where it does not keep step no periodic form
tells it; in the spectrum of the errors it is a line. Rough floors have none.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from scipy import stats
from scipy.signal import spectrogram

from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.fitting.views import views
from diffbot_sim.identification.free_forms.moments import MOST_OF_SAMPLE, SURE
from diffbot_sim.identification.free_forms.otherwise import FOLLOWING
from diffbot_sim.identification.free_forms.structure import FORCES
from diffbot_sim.identification.free_forms.variable import BODY
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.result import Structure
from diffbot_sim.identification.statistics.guards import weight
from diffbot_sim.identification.statistics.robust import scale_of
from diffbot_sim.records import Array

# Spectra are those of so long parts [s], half of each in the next one, too: a part is worth as
# many independent ones (Welch, 1967, for Hann's window).
SPAN, WORTH_OF_PART, FEWEST = 10.0, 0.95, 5
# Where lines are looked for [Hz], up to a share of the rate of the odometry.
SLOWEST, FASTEST, OF_ODOMETRY = 0.5, 8.0, 0.4
# A line ends so far to either side [Hz], and is held against what is there, as far as that.
ENDS, BESIDE = 0.2, 1.0
# It is so many times as strong, and as sure as a single push must be.
STANDS_OUT = 6.0


class Line(NamedTuple):
    """A line of a spectrum: its rate [Hz], its axis, 0 for v and 1 for ω, and its chance."""

    rate: float
    axis: int
    p_value: float


class _Spectra(NamedTuple):
    """Densities of parts of a stretch, (parts, rates, 2), and the middles of these [s]."""

    time: Array
    density: Array


def oscillating(fit: Fit) -> Structure | None:
    """Return the force that comes and goes at a rate of its own, if a fit shows one.

    Told over the time of the run in which it is strongest.
    """
    line = find_line(fit)
    return None if line is None else _described(fit, line)


def find_line(fit: Fit) -> Line | None:
    """Return the line that stands out most of the spectrum of a fit's errors, if one does."""
    density = np.concatenate([part.density for part in _spectra(fit)])
    first = round(SLOWEST * SPAN)
    if len(density) < FEWEST or density.shape[1] <= first:
        return None
    mean = density.mean(axis=0)
    times = np.stack([_times_beside(of_axis) for of_axis in mean.T], axis=1)[first:]
    row, axis = np.unravel_index(np.argmax(times), times.shape)
    known = 2.0 * WORTH_OF_PART * len(density)
    chance = times.size * float(stats.chi2.sf(known * times[row, axis], known))
    if times[row, axis] < STANDS_OUT or chance > SURE:
        return None
    return Line(float(first + row) / SPAN, int(axis), chance)


def _bounded(errors: Array) -> Array:
    """Return errors, shape (k, 2), none of them far beyond what is usual."""
    most = MOST_OF_SAMPLE * scale_of(errors)
    return np.clip(errors, -most, most)


def _spectra(fit: Fit) -> list[_Spectra]:
    """Return spectra of the errors on each stretch, at all multiples of 1 / SPAN [Hz]."""
    interval = max(stretch.interval for stretch in fit.stretches)
    rates = 1 + int(min(FASTEST, OF_ODOMETRY / interval) * SPAN)
    return [
        _spectra_of(v.stretch, _bounded(v.innovation), rates) for v in views(fit, fit.stretches)
    ]


def _spectra_of(stretch: Stretch, errors: Array, rates: int) -> _Spectra:
    samples = round(SPAN / stretch.interval)
    even = np.arange(stretch.time[0], stretch.time[-1], SPAN / samples)
    if len(even) < samples:
        return _Spectra(np.empty(0), np.empty((0, rates, 2)))
    evenly = np.stack([np.interp(even, stretch.time, of_axis) for of_axis in errors.T], axis=1)
    _, time, density = spectrogram(
        evenly, samples / SPAN, 'hann', samples, samples // 2, axis=0, mode='psd'
    )
    return _Spectra(even[0] + time, np.moveaxis(density, -1, 0)[:, :rates])


def _times_beside(density: Array) -> Array:
    """Return how many times a density is what is usual beside it, on whichever side is more."""
    near, far = round(ENDS * SPAN), round(BESIDE * SPAN)
    usual = [_beside(density, at, near, far) for at in range(len(density))]
    return density / np.maximum(usual, np.finfo(float).tiny)


def _beside(density: Array, at: int, near: int, far: int) -> float:
    """Return the larger median of what is below and above; endless where one side is missing."""
    below = density[max(1, at - far) : max(1, at - near + 1)]
    above = density[at + near : at + far + 1]
    if min(len(below), len(above)) <= near:
        return np.inf
    return float(max(np.median(below), np.median(above)))


def _described(fit: Fit, line: Line) -> Structure:
    """Tell a line with its force, as it comes and goes."""
    time, force, error = max(_forces(fit, line), key=lambda told: _strength(*told[1:]))
    kind, unit = FORCES[BODY[line.axis]]
    strength = _strength(force, error)
    return Structure(
        description=(
            f'a {kind} of {strength:.3g} {unit} rms that comes and goes {line.rate:.2g} times a '
            'second, whatever the robot does, and that no effect of the library accounts for'
        ),
        axis=BODY[line.axis],
        variable='oscillation',
        over='time [s]',
        strength=strength,
        p_value=line.p_value,
        knots=time,
        force=force,
        force_error=error,
        worth=weight([line.p_value]),
    )


def _strength(force: Array, error: Array) -> float:
    """Return the rms of a force, of which counts most what is surest."""
    return float(np.sqrt(np.average(force**2, weights=error**-2.0)))


def _forces(fit: Fit, line: Line) -> list[tuple[Array, Array, Array]]:
    """Return times, rms force and its error in the parts of each stretch that has some.

    Of a model that is corrected at each sample an error tells the force since the last one.
    """
    body = float(fit.model.pack()[line.axis])
    at, near, far = (round(span * SPAN) for span in (line.rate, ENDS, BESIDE))
    told = []
    spectra = _spectra(replace(fit, gains=FOLLOWING))
    for stretch, (time, density) in zip(fit.stretches, spectra, strict=True):
        of_axis, scale = density[..., line.axis], body / stretch.interval
        whole = of_axis[:, at - near : at + near + 1].sum(axis=1) / SPAN
        usual = np.array([_beside(part, at, near, far) for part in of_axis])
        beside = usual * (2 * near + 1) / SPAN
        above = np.sqrt(np.maximum(whole - beside, 0.0))
        # Encoders of a robot that stands make no errors at all, and tell nothing.
        felt = beside > 0.0
        if np.any(felt):
            told.append((time[felt], scale * above[felt], scale * np.sqrt(beside[felt])))
    return told
