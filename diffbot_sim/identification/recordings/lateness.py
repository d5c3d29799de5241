"""How much older a measured twist is than its stamp: many drivers tell a mean over the past.

Encoders are differenced, which gives the mean since the sample before, half an interval late; a
rolling mean or a filter makes it later still. Both look like actuators that are late.
"""

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from typing import Literal, NamedTuple

import numpy as np
from scipy.optimize import minimize_scalar

from diffbot_sim.identification.recordings.intervals import median_interval
from diffbot_sim.identification.recordings.smoothing import smoothed_over
from diffbot_sim.identification.recordings.stretches import averaged
from diffbot_sim.identification.recordings.way import path_of
from diffbot_sim.identification.result import Timing
from diffbot_sim.identification.statistics.norms import white_noise
from diffbot_sim.records import Array, Odometry, Run

# What makes a robot late: parameters whose sum is how late it is [s].
LATE = ('actuator_delay.time', 'actuator_lag.time_constant')
LATE_EFFECTS = tuple(name.partition('.')[0] for name in LATE)
# Longest lag behind the pose [s] that is looked for, and grid points in an interval.
LONGEST, FINENESS = 0.5, 4
# What lags by more than this share of an interval is a mean, whichever way the pose came about.
BEYOND_HALF = 0.75
# A shorter run [s] does not tell it.
SHORTEST = 10.0
# A pose that moves otherwise than the twist says, by more than this share, tells nothing.
ALIKE = 0.3
# By how much twice the log-likelihood must rise where a lag behind the pose is believed.
BEYOND_CHANCE = 50.0
# The share of noise in a pose's changes up to which they tell more than a late twist.
CLEAR = 0.1
# A speed [m/s, rad/s] that is as good as none.
TINY = 1e-9

# The components of a twist, and those of a path beside them, that are looked at.
Components = tuple[int, ...]
TWIST: Components = (0, 1)
SPEED: Components = (0,)


def timely(run: Run) -> Run:
    """Return a run whose twist is of the time of its pose.

    A lag of about half an interval is left as it is: poses that are integrated from the twist lead
    it or lag behind it by so much. A longer mean, or one to both sides, hides what is fast: the
    twist is taken from the pose's changes, over as many samples as noise and the mean ask for.
    """
    longest = _length_of_mean(run.odometry)
    taken = run
    for group in range(1, longest + 1):
        taken = as_pose_moves(averaged(run, group))
        twist = taken.odometry.twist
        if np.all(white_noise(twist) < CLEAR * np.sqrt(np.mean(twist**2, axis=0))):
            break
    return taken


def _length_of_mean(odometry: Odometry) -> int:
    """Return over about how many samples to a side the twist is a mean, 0 if not for long."""
    lag, interval = lag_behind_pose(odometry), median_interval(odometry.time)
    if lag > BEYOND_HALF * interval:
        return round(lag / interval)
    if odometry.pose is None or odometry.time[-1] - odometry.time[0] < SHORTEST:
        return 0
    turned = np.diff(odometry.pose[:, 2]) / np.diff(odometry.time)
    return smoothed_over(turned, odometry.twist[1:, 1])


def as_pose_moves(run: Run) -> Run:
    """Return a run whose twist is the mean change of the pose since the sample before."""
    seen = run.odometry
    if seen.pose is None:
        return run
    twist = np.diff(path_of(seen.pose), axis=0) / np.diff(seen.time)[:, None]
    return replace(run, odometry=Odometry(seen.time[1:], twist, seen.pose[1:], (True, True)))


def timing(given: Run, taken: Run) -> Timing | None:
    """Return how a run's twists were taken that had been given; None where as they are."""
    before, after = given.odometry, taken.odometry
    if after is before:
        return None
    if after.twist is not before.twist:
        lag = lag_behind_pose(before)
        return Timing(given.name, max(0.0, lag), 'pose' if lag > 0.0 else 'smoothed')
    what: Literal['mean', 'speed'] = 'mean' if all(after.means) else 'speed'
    return Timing(given.name, half_interval(given), what)


def half_interval(run: Run) -> float:
    """Return by how much a mean since the sample before is late [s]."""
    return 0.5 * median_interval(run.odometry.time)


def of_interval_before(run: Run) -> Run:
    """Return a run whose twist is taken for the mean since the sample before."""
    return replace(run, odometry=replace(run.odometry, means=(True, True)))


def speed_of_interval_before(run: Run) -> Run:
    """Return a run whose speed alone is taken for that, its turn rate for a gyro's."""
    return replace(run, odometry=replace(run.odometry, means=(True, False)))


def pose_allows_lag(run: Run, of: Components) -> bool:
    """Say whether a twist may be late: a pose that was not integrated from it would tell."""
    seen = run.odometry
    if all(seen.means):
        return False
    return seen.pose is None or lag_behind_pose(seen, of) > 0.25 * median_interval(seen.time)


def lateness_of(values: Mapping[str, float]) -> float:
    """Return how late a robot of these parameters is [s]."""
    return sum(values.get(name, 0.0) for name in LATE)


def lag_behind_pose(odometry: Odometry, of: Components = TWIST) -> float:
    """Return by how much a twist, or a part of it, lags the change of the pose [s].

    0 where that is not sure.
    """
    if odometry.pose is None or odometry.time[-1] - odometry.time[0] < SHORTEST:
        return 0.0
    step = median_interval(odometry.time) / FINENESS
    misfit = partial(_misfit, odometry, path_of(odometry.pose), of)
    lags = np.arange(-FINENESS, LONGEST / step) * step
    best = float(lags[int(np.argmin([misfit(lag).cost for lag in lags]))])
    found = minimize_scalar(
        lambda lag: misfit(lag).cost, bounds=(best - step, best + step), method='bounded'
    )
    at_best = misfit(found.x)
    sure = misfit(0.0).cost - at_best.cost > BEYOND_CHANCE
    return float(found.x) if sure and at_best.share < ALIKE else 0.0


class _Misfit(NamedTuple):
    """How twists differ from the changes of a pose: -2 log-likelihood; share of the twists."""

    cost: float
    share: float


def _misfit(odometry: Odometry, path: Array, of: Components, lag: float) -> _Misfit:
    """Hold the twist against the mean change of way and heading about a moment before."""
    time, interval = odometry.time, median_interval(odometry.time)
    inner = (time > time[0] + LONGEST + interval) & (time < time[-1] - 2.0 * interval)
    at, twist = time[inner] - lag, odometry.twist[inner][:, of]
    after, before = (
        np.column_stack([np.interp(at + side, time, column) for column in path[:, of].T])
        for side in (interval, -interval)
    )
    errors = np.mean((twist - (after - before) / (2.0 * interval)) ** 2, axis=0) + TINY**2
    whole = np.mean(twist**2, axis=0) + TINY**2
    return _Misfit(len(at) * float(np.log(errors).sum()), float(np.sqrt(errors / whole).min()))
