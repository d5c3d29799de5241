"""Odometry that went through a low-pass filter: found by its likelihood, and undone.

A filter looks like a lag of the actuators, for motion is nearly linear in the forces. But it also
passes the noise: errors that are white before a filter are not after it. Noise may be coloured by
something else; then its colour and the lag have time constants of their own.
"""

from dataclasses import replace
from math import exp, inf, log

import numpy as np
from scipy.optimize import minimize_scalar

from diffbot_sim.identification.fitting.coordinates import Space
from diffbot_sim.identification.fitting.fit import FIRST_GAINS, Fit, fit_prediction, fit_simulation
from diffbot_sim.identification.fitting.predictor import MAX_STEP
from diffbot_sim.identification.recordings.lateness import LATE, LATE_EFFECTS
from diffbot_sim.identification.recordings.start import restarted
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.statistics.memory import unforeseen
from diffbot_sim.identification.statistics.norms import resolution
from diffbot_sim.records import Array, Run

# Twice a log-likelihood that is so much higher is no chance.
CLEAR = 10.0
# How far from an effect's lateness the time constant is looked for, and how closely: shares.
WITHIN, CLOSELY, LOOKS = 4.0, 0.02, 12


def unfiltered(run: Run, time_constant: float) -> Run:
    """Return a run with its twists as they were before a first-order filter [s]."""
    seen = run.odometry
    twist = _undone(seen.time, seen.twist, time_constant)
    return replace(run, odometry=replace(seen, twist=twist))


def filter_behind(fit: Fit) -> float:
    """Return the time constant [s] of a filter that explains more than an effect that is late.

    0 where no effect is late, nothing speaks for a filter, noise of a colour of its own explains
    more, or twists come in steps as coarse as the errors: those were made behind any filter.
    """
    if np.any(resolution(np.concatenate([s.twist for s in fit.stretches])) > fit.sigma):
        return 0.0
    values = fit.space.values(fit.u)
    late = [(values.get(name, 0.0), e) for name, e in zip(LATE, LATE_EFFECTS, strict=True)]
    looks = [(_cost_before(fit, e, time), time, e) for time, e in late if time > 0.0]
    cost, near, effect = min(looks, default=(inf, 0.0, ''))
    if cost > _cost(fit) - CLEAR:
        return 0.0
    found = minimize_scalar(
        lambda at: _cost_before(fit, effect, exp(at)),
        bounds=(log(near / WITHIN), log(near * WITHIN)),
        method='bounded',
        options={'xatol': CLOSELY, 'maxiter': LOOKS},
    )
    return exp(found.x) if found.fun < _cost_of_colour(fit) + CLEAR else 0.0


def _cost_before(fit: Fit, effect: str, time_constant: float) -> float:
    """Return -2 log-likelihood where a filter takes the place of an effect."""
    undone = tuple(_before(stretch, time_constant) for stretch in fit.stretches)
    space = Space(fit.space.declared, tuple(k for k in fit.space.kinds if k.name != effect))
    start = np.delete(fit.u, fit.space.places(effect))
    stretches = restarted(space.model(start), undone, MAX_STEP)
    before = fit_prediction(space, stretches, start, FIRST_GAINS)
    shares = [_passed(stretch.time, time_constant)[stretch.used[1:] > 0] for stretch in stretches]
    return _cost(before) + 4.0 * float(np.log(np.concatenate(shares)).sum())


def _cost_of_colour(fit: Fit) -> float:
    """Return -2 log-likelihood where all that past errors tell is the colour of the noise."""
    return _cost(fit_simulation(fit.space, fit.stretches, fit.u))


def _cost(fit: Fit) -> float:
    """Return -2 log-likelihood of what past errors do not tell, less what all fits share."""
    return len(fit.whitened) * float(np.log(unforeseen(fit.whitened) * fit.sigma**2).sum())


def _before(stretch: Stretch, time_constant: float) -> Stretch:
    return replace(stretch, twist=_undone(stretch.time, stretch.twist, time_constant))


def _undone(time: Array, twist: Array, time_constant: float) -> Array:
    """Return what a first-order filter was given; the first sample as it is."""
    passed = _passed(time, time_constant)[:, None]
    return np.vstack([twist[:1], twist[:-1] + np.diff(twist, axis=0) / passed])


def _passed(time: Array, time_constant: float) -> Array:
    """Return the share of each change that a filter lets through at once."""
    return np.asarray(-np.expm1(-np.diff(time) / time_constant))
