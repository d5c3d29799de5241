"""Odometry that went through a low-pass filter: found by its likelihood, and undone.

A filter looks like a lag of the actuators, for motion is nearly linear in the forces. But it also
passes the noise: errors that are white before a filter are not after it. Noise may be coloured by
something else; then its colour and the lag have time constants of their own.
"""

from collections.abc import Sequence
from dataclasses import replace
from math import exp, inf
from operator import attrgetter, itemgetter
from typing import NamedTuple

import numpy as np

from diffbot_sim.identification.fitting.coordinates import Space, point_of
from diffbot_sim.identification.fitting.filter_fits import DEVIATION, Block, fitted, of_structure
from diffbot_sim.identification.fitting.fit import (
    FIRST_GAINS,
    Fit,
    fit_prediction,
    fit_simulation,
    innovations,
)
from diffbot_sim.identification.fitting.standing_noise import denied_at_rest
from diffbot_sim.identification.recordings.filters import (
    AGES,
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
from diffbot_sim.identification.statistics.minimisation import Prior
from diffbot_sim.identification.statistics.norms import resolution
from diffbot_sim.identification.statistics.parallel import side_by_side
from diffbot_sim.physics.effects.actuator_lag import ActuatorLag
from diffbot_sim.records import Array

# How far from an effect's lateness the time constant is looked for: by such a factor.
WITHIN = 4.0
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
    """A filter beside what is left once it is undone, with the cost of both: -2 log-likelihood.

    left: stretches as they were recorded, at the point and the gains where a fit begins or ended.
    """

    cost: float
    behind: FirstOrder
    left: Fit

    def best(self, shortest: float, longest: float) -> '_Look':
        """Fit the time constant [s], between two, together with all else."""
        left, size, age = self.left, len(self.left.u), self.behind.age
        undone = [before(stretch, self.behind) for stretch in left.stretches]
        starts = [stretch.start for stretch in restarted(left.model, undone)]
        pairs = zip(left.stretches, starts, strict=True)
        stretches = tuple(replace(stretch, start=start) for stretch, start in pairs)

        def errors(at: Array) -> Array:
            behind = FirstOrder(exp(at[-1]), age)
            undone = [before(stretch, behind) for stretch in stretches]
            missed = innovations(undone, left.space.model(at[:size]), at[size:-1])
            return missed * _let_through(stretches, behind.time_constant)

        time, bounds = np.log([self.behind.time_constant]), np.log([[shortest], [longest]])
        of_filter = Block(time, Prior(time, np.array([DEVIATION])), (bounds[0], bounds[1]))
        at, cost = fitted(errors, [of_structure(left.space, left.u, left.gains), of_filter])
        end = replace(left, stretches=stretches, u=at[:size], gains=at[size:-1])
        return _Look(cost, FirstOrder(exp(at[-1]), age), end)


def _let_through(stretches: Sequence[Stretch], time_constant: float) -> float:
    """Return the share of a change that a filter lets through at once, the geometric mean."""
    shares = [passed_at_once(s.time, time_constant)[s.used[1:]] for s in stretches]
    return exp(float(np.log(np.concatenate(shares)).mean()))


def _likelier(
    left: Fit, most: float, tried: Sequence[float], within: tuple[float, float]
) -> list[tuple[float, FirstOrder]]:
    """Return the best filter of each age, if it costs no more than most.

    left: what is fitted once it is undone; tried: where the time constant begins [s]; within: the
    shortest and the longest.
    """
    # The noise model has followed what was filtered.
    left = replace(left, gains=FIRST_GAINS)
    each_sample, often = AGES
    looks = [_Look(inf, FirstOrder(at, each_sample), left) for at in tried]
    ends = side_by_side(lambda look: look.best(*within), looks)
    one = min(ends, key=attrgetter('cost'))
    # A filter that is told more often is nearly the same.
    other = one._replace(behind=one.behind._replace(age=often)).best(*within)
    return [(look.cost, look.behind) for look in (one, other) if look.cost <= most]


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
