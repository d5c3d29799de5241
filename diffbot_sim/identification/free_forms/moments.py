"""Moments at which something pushed the robot: no law of what the robot does tells them."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy import stats

from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.fitting.response import Response, responses
from diffbot_sim.identification.fitting.views import View, views
from diffbot_sim.identification.free_forms.structure import FORCES
from diffbot_sim.identification.free_forms.variable import BODY
from diffbot_sim.identification.result import Structure
from diffbot_sim.identification.statistics.guards import LIKELIHOOD_LEVEL, weight
from diffbot_sim.identification.statistics.norms import rms
from diffbot_sim.identification.statistics.robust import NORMAL, scale_of
from diffbot_sim.records import Array

# How long a push is looked for [s]: a hand, a gust, a kerb; how far from anything unsteady its
# middle lies.
WINDOW, CLEAR = 0.5, 0.75
# One push may be an accident: it must be as sure as two that are beyond chance.
SURE = LIKELIHOOD_LEVEL**2
# No error counts for more than so many deviations: an outlier is no push.
MOST_OF_SAMPLE = 5.0
# A wheel slower than this share of its usual highest speed may stick or start, which is no push.
SLOW, USUALLY = 0.02, 0.95
# Odometry that misses so many intervals leaves the prediction alone.
HOLE = 3.0
# Where a wheel sticks, a force is so many times less sure than usual, and not shown.
FELT = 4.0
# Forces in steady windows that exceed the usual one so many times over are no rough floor: on 60
# clean robots none exceeded it by more than 4.4. Two of them are told.
OUTSTANDING, AT_LEAST = 6.0, 2
# What lasts for so long [s] is one push yet.
LASTING = 5.0
# So many windows at once: each takes two numbers for every sample of a stretch.
AT_ONCE = 50


class Moment(NamedTuple):
    """A window in which errors have one sign: middle [s] in a stretch; axis 0 for v, 1 for ω.

    p_value: the chance of such a one among all windows.
    """

    stretch: int
    time: float
    axis: int
    p_value: float


@dataclass(frozen=True)
class _Windows:
    """Middles [s] of steady windows, shape (m,); sums of errors over their deviation, (m, 2)."""

    time: Array
    sums: Array


def pushed(fit: Fit) -> Structure | None:
    """Return the force of pushes at a few moments, if a fit shows some.

    Its errors do, or, where its noise model follows a force that comes and goes, that force does.
    """
    moments = find_moments(fit)
    if len(moments) > 1 or any(moment.p_value <= SURE for moment in moments):
        return _described(fit, moments)
    return standing_out(fit)


def standing_out(fit: Fit) -> Structure | None:
    """Return the force of pushes that stand out of what a fit usually lacks, if there are some."""
    outstanding = find_outstanding(fit)
    return _described(fit, outstanding) if len(outstanding) >= AT_LEAST else None


def find_moments(fit: Fit) -> list[Moment]:
    """Return moments at which the errors of a fit add up to more than chance, the surest first."""
    each = [_windows(view) for view in views(fit, fit.stretches)]
    sums = np.concatenate([windows.sums for windows in each])
    if len(sums) == 0:
        return []
    # Errors that depend on the last ones add up to more, or less, than independent ones.
    deviation = np.maximum(scale_of(sums), 1.0)
    return _surest_apart(_beyond_chance(each, deviation, sums.size), 2.0 * WINDOW)


def find_outstanding(fit: Fit) -> list[Moment]:
    """Return moments at which the force that a fit lacks stands out of what it usually is."""
    felt = _felt(fit)
    found = (moment for axis in (0, 1) for moment in _outstanding(felt, axis))
    return _surest_apart(found, LASTING)


def _felt(fit: Fit) -> list[tuple[View, Response]]:
    """Return each stretch as a fit sees it, and how its errors answer to pushes."""
    return list(zip(views(fit, fit.stretches), responses(fit), strict=True))


def _outstanding(felt: Sequence[tuple[View, Response]], axis: int) -> Iterator[Moment]:
    parts = [_steadily(view, *over_time(view, response, axis)) for view, response in felt]
    _, force, errors = np.hstack(parts)
    if len(force) == 0:
        return
    middle = np.median(force)
    usual = max(NORMAL * float(np.median(np.abs(force - middle))), float(np.median(errors)))
    for index, (time, pushes, error) in enumerate(parts):
        times_usual = np.abs(pushes - middle) / np.maximum(usual, error)
        chances = len(force) * 2.0 * stats.norm.sf(times_usual)
        for row in np.flatnonzero(times_usual > OUTSTANDING).tolist():
            yield Moment(index, float(time[row]), axis, float(chances[row]))


def _steadily(view: View, time: Array, force: Array, error: Array) -> Array:
    """Return times, forces and errors around which nothing is unsteady, shape (3, m)."""
    unsteady = view.stretch.time[_is_unsteady(view)]
    ends = np.searchsorted(unsteady, time[None] + [[-CLEAR], [CLEAR]])
    return np.stack([time, force, error])[:, ends[0] == ends[1]]


def _surest_apart(moments: Iterable[Moment], span: float) -> list[Moment]:
    """Return the surest of moments within a span [s] of each other, the surest first."""
    found = list[Moment]()
    for moment in sorted(moments, key=lambda m: m.p_value):
        if not any(_is_near(moment, other, span) for other in found):
            found.append(moment)
    return found


def _beyond_chance(each: list[_Windows], deviation: Array, tried: int) -> Iterator[Moment]:
    for index, windows in enumerate(each):
        chances = tried * 2.0 * stats.norm.sf(np.abs(windows.sums) / deviation)
        for row, axis in np.argwhere(chances <= LIKELIHOOD_LEVEL).tolist():
            yield Moment(index, float(windows.time[row]), axis, float(chances[row, axis]))


def _is_near(one: Moment, other: Moment, span: float) -> bool:
    return one.stretch == other.stretch and abs(one.time - other.time) <= span


def _windows(view: View) -> _Windows:
    """Add up errors in windows, one for each sample, where nothing near is unsteady."""
    time, used = view.stretch.time, view.stretch.used
    errors = np.clip(view.innovation / view.fit.sigma, -MOST_OF_SAMPLE, MOST_OF_SAMPLE)

    def within(values: Array, margin: float) -> Array:
        total = np.concatenate([np.zeros((1, *values.shape[1:])), np.cumsum(values, axis=0)])
        first = np.searchsorted(time, time - margin, 'left')
        end = np.searchsorted(time, time + margin, 'right')
        return np.asarray(total[end] - total[first])

    count = within(used.astype(float), 0.5 * WINDOW)
    full = count >= 0.5 * WINDOW / view.stretch.interval
    steady = full & (within(_is_unsteady(view).astype(float), CLEAR) == 0.0)
    sums = within(errors, 0.5 * WINDOW)[steady] / np.sqrt(count[steady, None])
    return _Windows(time[steady], sums)


def _is_unsteady(view: View) -> Array:
    """Say of each sample whether a wheel may stick there, or odometry was missing."""
    speed, time = np.abs(view.wheel_speed), view.stretch.time
    slow = np.any(speed <= SLOW * np.quantile(speed, USUALLY, axis=0), axis=1)
    missing = np.diff(time, prepend=time[0]) > HOLE * view.stretch.interval
    return np.asarray(slow | missing)


def _described(fit: Fit, moments: list[Moment]) -> Structure:
    """Tell moments with their forces, and the force over time where the surest one is."""
    felt = _felt(fit)
    said = ', '.join(_said(*felt[m.stretch], m, _whose(fit, m)) for m in sorted(moments))
    surest = moments[0]
    view, response = felt[surest.stretch]
    knots, force, error = over_time(view, response, surest.axis)
    what = 'pushes' if len(moments) > 1 else 'a push'
    return Structure(
        description=f'{what} at {said} that no effect of the library accounts for',
        axis=BODY[surest.axis],
        variable='time_of_push',
        over='time [s]',
        strength=rms(force),
        p_value=surest.p_value,
        knots=knots,
        force=force,
        force_error=error,
        worth=weight(moment.p_value for moment in moments),
    )


def _said(view: View, response: Response, moment: Moment, whose: str) -> str:
    (force,), _ = _acting(view, response, moment.axis, np.array([moment.time]))
    _, unit = FORCES[BODY[moment.axis]]
    return f'{moment.time:.1f} s{whose} ({force:.3g} {unit})'


def _whose(fit: Fit, moment: Moment) -> str:
    """Tell the run of a moment where there are several."""
    return f' of {fit.stretches[moment.stretch].run.name}' if len(fit.stretches) > 1 else ''


def over_time(view: View, response: Response, axis: int) -> tuple[Array, Array, Array]:
    """Return times of a stretch, the force in a window around each, and its standard error."""
    time = view.stretch.time
    knots = np.arange(time[0] + WINDOW, time[-1] - WINDOW, 0.5 * WINDOW)
    parts = np.array_split(knots, 1 + len(knots) // AT_ONCE)
    force, error = np.hstack([_acting(view, response, axis, part) for part in parts])
    felt = error[np.isfinite(error)]
    shown = error <= (FELT * np.median(felt) if len(felt) else 0.0)
    return knots[shown], force[shown], error[shown]


def _acting(view: View, response: Response, axis: int, middles: Array) -> tuple[Array, Array]:
    """Return forces in windows that explain the errors best, and their standard errors.

    An infinite error where no force is felt. The noise model soon follows a force: what it follows
    comes on top of what errors tell.
    """
    time, sigma = view.stretch.time, view.fit.sigma
    within = np.abs(time[:, None] - middles) <= 0.5 * WINDOW
    acting = np.zeros((len(time), 2, len(middles)))
    acting[:, axis] = within
    answers = response.errors(acting)
    slopes = answers / sigma[:, None] * view.stretch.used[:, None, None]
    known = np.sum(slopes**2, axis=(0, 1))
    with np.errstate(divide='ignore', invalid='ignore'):
        told = np.nan_to_num(-np.einsum('kaq,ka->q', slopes, view.innovation / sigma) / known)
        error = known**-0.5
    disturbance = view.prediction.disturbance[:, axis, None]
    followed = disturbance + told * response.followed(answers)[:, axis]
    # A window that odometry missed has no sample, and no force is felt there.
    return told + np.sum(followed, axis=0, where=within) / np.maximum(within.sum(axis=0), 1), error
