"""How much older a measured twist is than its stamp: many drivers tell a mean over the past.

Encoders are differenced, which gives the mean since the sample before, half an interval late; a
rolling mean or a filter makes it later still. Both look like actuators that are late.
"""

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from typing import Literal

import numpy as np
from scipy.optimize import minimize_scalar
from scipy.stats import wilcoxon

from diffbot_sim.identification.recordings.counts import is_counted
from diffbot_sim.identification.recordings.intervals import median_interval
from diffbot_sim.identification.recordings.smoothing import smoothed_over
from diffbot_sim.identification.recordings.stretches import averaged
from diffbot_sim.identification.recordings.way import pose_knows_more
from diffbot_sim.identification.result import Timing
from diffbot_sim.identification.statistics.norms import rms_of_each, white_noise
from diffbot_sim.physics.kinematics import path_of
from diffbot_sim.records import Array, Odometry, Run
from diffbot_sim.standing import unfilled

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
# The chance, by signed ranks, below which one lag behind the pose is believed rather than another.
CHANCE = 1e-8
# The share of noise in a pose's changes up to which they tell more than a late twist.
CLEAR = 0.1
# Samples to each side over which a path is smoothed, and how far apart ones are that are compared:
# so far that smoothing gives them no noise in common.
NEIGHBOURS, APART = 4, 5
# Over how many samples at most a twist is taken from the pose where nobody filled it.
LONGEST_MEAN = 10
# A speed [m/s, rad/s] that is as good as none.
TINY = 1e-9
# A path that is a sum of twists misses it by less than this share of what the ways to add them up
# differ by.
SUMMED = 0.01

# The components of a twist, and those of a path beside them, that are looked at.
Components = tuple[int, ...]
TWIST: Components = (0, 1)
SPEED: Components = (0,)


def timely(run: Run) -> Run:
    """Return a run whose twist is of the time of its pose.

    A lag of about half an interval is left as it is: poses that are integrated from the twist lead
    it or lag behind it by so much; but whole counts are means. A longer mean, or one to both
    sides, hides what is fast: the twist is taken from the pose's changes, over as many samples as
    noise and the mean ask for.
    """
    if is_counted(run.odometry):
        return of_interval_before(run)
    return _by_pose(run, _length_of_mean(run.odometry))


def filled(run: Run) -> Run:
    """Return a run whose twist is taken from its pose, if nobody filled it."""
    return _by_pose(run, LONGEST_MEAN) if any(unfilled(run.odometry)) else run


def _by_pose(run: Run, longest: int) -> Run:
    """Return a run whose twist is taken from the pose, over as few samples as noise allows."""
    taken = run
    for group in range(1, longest + 1):
        taken = as_pose_moves(averaged(run, group))
        twist = taken.odometry.twist
        if np.all(white_noise(twist) < CLEAR * rms_of_each(twist)):
            break
    return taken


def _length_of_mean(odometry: Odometry) -> int:
    """Return over about how many samples to a side the twist is a mean, 0 if not for long."""
    lag, interval = lag_behind_pose(odometry), median_interval(odometry.time)
    if lag > BEYOND_HALF * interval:
        return round(lag / interval)
    path = _telling_path(odometry)
    if path is None:
        return 0
    turned = np.diff(path[:, 1]) / np.diff(odometry.time)
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
    return Timing(given.name, half_interval(given), _what_is_mean(after))


def _what_is_mean(taken: Odometry) -> Literal['counts', 'mean', 'speed']:
    if not all(taken.means):
        return 'speed'
    return 'counts' if is_counted(taken) else 'mean'


def half_interval(run: Run) -> float:
    """Return by how much a mean since the sample before is late [s]."""
    return 0.5 * median_interval(run.odometry.time)


def of_interval_before(run: Run) -> Run:
    """Return a run whose twist is taken for the mean since the sample before."""
    return replace(run, odometry=replace(run.odometry, means=(True, True)))


def speed_of_interval_before(run: Run) -> Run:
    """Return a run whose speed alone is taken for that, its turn rate for a gyro's."""
    return replace(run, odometry=replace(run.odometry, means=(True, run.odometry.means[1])))


def pose_allows_lag(run: Run, of: Components) -> bool:
    """Say whether a twist may be a mean since the sample before: its pose would tell if not."""
    seen = run.odometry
    path = _telling_path(seen)
    return path is None or not _is_less_late(seen, path, of, half_interval(run))


def pose_denies_lag(run: Run, lag: float) -> bool:
    """Say whether a pose that was not made of the twist tells that it is not so late [s]."""
    seen = run.odometry
    path = _telling_path(seen) if pose_knows_more(seen) else None
    return path is not None and _is_less_late(seen, path, TWIST, lag)


def lateness_of(values: Mapping[str, float]) -> float:
    """Return how late a robot of these parameters is [s]."""
    return sum(values.get(name, 0.0) for name in LATE)


def lag_behind_pose(odometry: Odometry) -> float:
    """Return by how much twists lag the change of the pose [s].

    0 where that is not sure.
    """
    path = _telling_path(odometry)
    if path is None:
        return 0.0
    step = median_interval(odometry.time) / FINENESS
    errors = partial(_errors, odometry, path, TWIST)
    lags = np.arange(-FINENESS, LONGEST / step) * step
    best = float(lags[int(np.argmin([_cost(errors(lag)) for lag in lags]))])
    found = minimize_scalar(
        lambda lag: _cost(errors(lag)), bounds=(best - step, best + step), method='bounded'
    )
    left = errors(found.x)
    share = np.sqrt(np.nanmean(left**2, axis=0) / (np.mean(odometry.twist**2, axis=0) + TINY**2))
    return float(found.x) if share.min() < ALIKE and _surely_less(left, errors(0.0)) else 0.0


def _telling_path(odometry: Odometry) -> Array | None:
    """Return way and heading by the pose, shape (k, 2); None where none tells more than twists."""
    if odometry.pose is None or odometry.time[-1] - odometry.time[0] < SHORTEST:
        return None
    path = path_of(odometry.pose)
    return None if _is_summed(path, odometry) else path


def _is_summed(path: Array, odometry: Odometry) -> bool:
    """Say whether a path is a sum of the twists before steps, or at both ends of them.

    Then it is of their time, whatever that is. A sum of those after the steps is what encoders
    count, of which twists are means.
    """
    moved, steps = np.diff(path, axis=0), np.diff(odometry.time)[:, None]
    before, after = steps * odometry.twist[:-1], steps * odometry.twist[1:]
    apart = rms_of_each(after - before)
    ways = (moved - share * before - (1.0 - share) * after for share in (1.0, 0.5))
    return any(np.all(rms_of_each(missed) < SUMMED * apart) for missed in ways)


def _errors(odometry: Odometry, path: Array, of: Components, lag: float) -> Array:
    """Return how twists differ from the mean change of way and heading about a moment before.

    Shape (n, q), not a number where nothing tells.
    """
    time, interval = odometry.time, median_interval(odometry.time)
    edge = (NEIGHBOURS + 1) * interval
    inner = np.flatnonzero((time > time[0] + LONGEST + edge) & (time < time[-1] - edge))[::APART]
    told, at = np.column_stack([time, path[:, of]]), time[inner] - lag
    after, before = (_smoothed(told, at + side, interval) for side in (interval, -interval))
    moved = after - before
    return np.asarray(odometry.twist[inner][:, of] - moved[:, 1:] / moved[:, :1])


def _is_less_late(odometry: Odometry, path: Array, of: Components, lag: float) -> bool:
    """Say whether a path tells that twists are of its time rather than so late [s]."""
    timely, late = (_errors(odometry, path, of, by) for by in (0.0, lag))
    return _surely_less(timely, late)


def _cost(errors: Array) -> float:
    return float(np.log(np.nanmean(errors**2, axis=0) + TINY**2).sum())


def _surely_less(errors: Array, others: Array) -> bool:
    """Say whether errors are smaller than others beyond chance, that of a noisy pose included.

    Moments apart are noisy each in its own way: that some noise is smaller proves no lag.
    """
    scale = np.nanmean(errors**2, axis=0) + TINY**2
    gained = np.sum((others**2 - errors**2) / scale, axis=1)
    told = gained[np.isfinite(gained) & (gained != 0.0)]
    return len(told) > 0 and bool(wilcoxon(told, alternative='greater').pvalue < CHANCE)


def _smoothed(told: Array, at: Array, interval: float) -> Array:
    """Return means about moments, shape (n, q), of what is told over time, its first column.

    Weighed by a Gaussian as wide as an interval: it leaves as much of white noise at a sample as
    between two. Interpolation leaves half of it there, and noisy poses would seem to fit best. Not
    a number where a hole lies around.
    """
    near = np.searchsorted(told[:, 0], at)[:, None] + np.arange(-NEIGHBOURS, NEIGHBOURS)
    near = np.clip(near, 0, len(told) - 1)
    weights = np.exp(-0.5 * ((told[near, 0] - at[:, None]) / interval) ** 2)
    with np.errstate(invalid='ignore'):
        weights /= weights.sum(axis=1, keepdims=True)
    return np.asarray(np.einsum('nk,nkq->nq', weights, told[near]))
