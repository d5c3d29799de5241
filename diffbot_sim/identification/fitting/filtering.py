"""Odometry that went through a low-pass filter: found by its likelihood, and undone.

A filter looks like a lag of the actuators, for motion is nearly linear in the forces. But it also
passes the noise: errors that are white before a filter are not after it. Noise may be coloured by
something else; then its colour and the lag have time constants of their own.
"""

from collections.abc import Sequence
from math import exp, inf, log
from operator import itemgetter
from typing import NamedTuple

import numpy as np
from scipy.optimize import minimize_scalar

from diffbot_sim.identification.fitting.coordinates import Space, point_of
from diffbot_sim.identification.fitting.fit import FIRST_GAINS, Fit, fit_prediction, fit_simulation
from diffbot_sim.identification.fitting.standing_noise import denied_at_rest
from diffbot_sim.identification.recordings.filters import (
    AGES,
    Age,
    FirstOrder,
    before,
    passed_at_once,
)
from diffbot_sim.identification.recordings.lateness import (
    LATE,
    LATE_EFFECTS,
    lateness_of,
    pose_denies_lag,
)
from diffbot_sim.identification.recordings.start import restarted
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.statistics.guards import VERY_STRONG
from diffbot_sim.identification.statistics.memory import deviance_beyond_past
from diffbot_sim.identification.statistics.norms import resolution
from diffbot_sim.physics.effects.actuator_lag import ActuatorLag
from diffbot_sim.records import Array

# How far from an effect's lateness the time constant is looked for, and how closely: shares.
WITHIN, CLOSELY, LOOKS = 4.0, 0.02, 12
# Rounds of the fits that are compared.
ROUNDS = 2
# Shares of an effect's lateness at which a filter beside it is tried first.
BESIDE = (0.5, 0.125)


class Likelier(NamedTuple):
    """A filter that explains something; worth: by how much it lowers -2 log-likelihood."""

    filter: FirstOrder
    worth: float

    def outdoes(self, fit: Fit, other: Fit) -> bool:
        """Say whether it explains more of what a fit leaves than another fit does."""
        return self.worth > _cost(fit) - _cost(other)


def filter_behind(fit: Fit) -> Likelier | None:
    """Return a filter that explains more than an effect that is late.

    It need explain only as much as one that is late by less than an interval of the odometry,
    unless a pose denies that twists are so late.
    None where no effect is late, nothing speaks for a filter, noise of a colour of its own or a
    lag explains more, though no lag was asked about, the noise of a robot that stands went through
    none, or twists come in steps as coarse as the errors: those were made behind any filter. Nor
    is one behind what is taken for means.
    """
    if any(all(stretch.run.odometry.means) for stretch in fit.stretches):
        return None
    if np.any(resolution(np.concatenate([s.twist for s in fit.stretches])) > fit.sigma):
        return None
    values = fit.space.values(fit.u)
    late = lateness_of(values)
    if late <= 0.0:
        return None
    cost = _cost(fit)
    found = [
        told
        for name, effect in zip(LATE, LATE_EFFECTS, strict=True)
        if (near := values.get(name, 0.0)) > 0.0
        for told in _likelier(
            fit.less(effect),
            cost + _allowed(fit.stretches, near),
            [near],
            (near / WITHIN, near * WITHIN),
        )
    ]
    least = min((told for told, _ in found), default=cost)
    tried = [late * share for share in BESIDE]
    found += _likelier(fit, least - VERY_STRONG, tried, (late / WITHIN**2, late))
    least, behind = min(found, key=itemgetter(0), default=(inf, None))
    if behind is None or denied_at_rest(fit, behind):
        return None
    if least >= _cost_of_colour(fit) + VERY_STRONG:
        return None
    if least >= _cost_of_lag(fit, behind.time_constant):
        return None
    return Likelier(behind, cost - least)


class _Look(NamedTuple):
    """A filter of some age that may be there; left: what is fitted once that is undone."""

    left: Fit
    age: Age

    def cost(self, time_constant: float) -> float:
        """Return -2 log-likelihood with a filter of this time constant."""
        return self._followed(time_constant, self.left.u, FIRST_GAINS)[0]

    def best(self, shortest: float, longest: float) -> tuple[float, FirstOrder]:
        """Return the lowest cost, and the filter that has it, with a time constant between two."""
        start = self.left.u, FIRST_GAINS

        def cost(at: float) -> float:
            nonlocal start
            told, end = self._followed(exp(at), *start)
            start = end.u, end.gains  # the next filter is nearly the same
            return told

        found = minimize_scalar(
            cost,
            bounds=(log(shortest), log(longest)),
            method='bounded',
            options={'xatol': CLOSELY, 'maxiter': LOOKS},
        )
        return float(found.fun), FirstOrder(exp(found.x), self.age)

    def _followed(self, time_constant: float, start: Array, gains: Array) -> tuple[float, Fit]:
        """Return -2 log-likelihood once a filter is undone, and the fit, begun at a point."""
        behind = FirstOrder(time_constant, self.age)
        undone = tuple(before(stretch, behind) for stretch in self.left.stretches)
        stretches = restarted(self.left.space.model(start), undone)
        fit = fit_prediction(self.left.space, stretches, start, gains, ROUNDS)
        shares = [passed_at_once(s.time, time_constant)[s.used[1:]] for s in stretches]
        return _cost(fit) + 4.0 * float(np.log(np.concatenate(shares)).sum()), fit


def _likelier(
    left: Fit, most: float, tried: Sequence[float], within: tuple[float, float]
) -> list[tuple[float, FirstOrder]]:
    """Return the best filter of each age, if one of those tried first costs no more than most.

    left: what is fitted once it is undone; within: the shortest and longest time constant [s].
    """
    looks = (_Look(left, age) for age in AGES)
    return [look.best(*within) for look in looks if any(look.cost(at) <= most for at in tried)]


def _allowed(stretches: Sequence[Stretch], near: float) -> float:
    """Return how much higher costs may be: what is late by less than an interval is odometry."""
    if near >= min(stretch.interval for stretch in stretches):
        return -VERY_STRONG
    denied = any(pose_denies_lag(stretch.run, near) for stretch in stretches)
    return -VERY_STRONG if denied else VERY_STRONG


def _cost_of_colour(fit: Fit) -> float:
    """Return -2 log-likelihood where all that past errors tell is the colour of the noise."""
    return _cost(fit_simulation(fit.space, fit.stretches, fit.u))


def _cost_of_lag(fit: Fit, near: float) -> float:
    """Return -2 log-likelihood where a lag takes the place of all that is late; near [s]."""
    present = {kind.name for kind in fit.space.kinds}
    if ActuatorLag.name in present | {effect.name for effect in fit.space.declared.effects}:
        return inf
    late = [place for name in present & set(LATE_EFFECTS) for place in fit.space.places(name)]
    kept = (kind for kind in fit.space.kinds if kind.name not in LATE_EFFECTS)
    start = np.append(np.delete(fit.u, late), point_of(ActuatorLag, (near,)))
    space = Space(fit.space.declared, (*kept, ActuatorLag))
    return _cost(fit_prediction(space, fit.stretches, start, fit.gains))


def _cost(fit: Fit) -> float:
    """Return -2 log-likelihood of what past errors do not tell, less what all fits share."""
    return deviance_beyond_past(fit.whitened, fit.sigma)
