"""Whether runs agree: each is held out in turn and compared with what the others say.

Each run is fitted on its own, from the joint fit on and with its noise model. What the others say
together is the mean of their own estimates, each weighted by its information: no further fits,
however many runs are held out.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import reduce
from operator import add
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
from scipy import stats

from diffbot_sim.identification.conclusions.uncertainty import estimates_at
from diffbot_sim.identification.conclusions.wandering import wandering
from diffbot_sim.identification.fitting.fit import Fit, fit_with_noise_held
from diffbot_sim.identification.recordings.free_running import run_free
from diffbot_sim.identification.recordings.start import restarted
from diffbot_sim.identification.recordings.stretches import Stretch, whole
from diffbot_sim.identification.result import Difference, Estimate, RunCheck
from diffbot_sim.identification.statistics.blocks import BLOCKS, block_scores
from diffbot_sim.identification.statistics.norms import noise_floor, norm
from diffbot_sim.physics.kinematics import wheel_speeds
from diffbot_sim.records import Array, Run

# Chance that one of several runs of the same robot is said to disagree.
LEVEL = 0.01
# Differences below this share of a parameter's typical size are no news, however certain.
IMMATERIAL = 0.02
# Evaluations for each run's own fit, in each of its two rounds.
EVALUATIONS = 4
NONE_ASIDE: Mapping[int, frozenset[str]] = MappingProxyType({})


@dataclass(frozen=True)
class Share:
    """What some runs say of the parameters, as sums over runs.

    information, shape (p, p): J'J at each run's own estimate; weighted, shape (p,): information
    times estimate; spread, shape (p, p): covariance of the score J'e, from blocks.
    """

    information: Array
    weighted: Array
    spread: Array

    def __add__(self, other: 'Share') -> 'Share':
        return Share(
            self.information + other.information,
            self.weighted + other.weighted,
            self.spread + other.spread,
        )


class Estimated(NamedTuple):
    """Parameters that some runs ask for, shape (p,), and their covariance, shape (p, p)."""

    u: Array
    covariance: Array


def agreement(
    joint: Fit, runs: Sequence[Run], aside: Mapping[int, frozenset[str]] = NONE_ASIDE
) -> tuple[RunCheck, ...]:
    """Judge each run by the others; nothing where there is only one.

    joint: the final structure, fitted to the runs by one-step prediction, but for those set aside;
    aside: what effects these have that the others lack.
    """
    if len(runs) < 2:
        return ()
    fits, shares = _each_alone(joint, runs)
    odd = disagreeing(joint, fits, shares, frozenset(aside))
    checks = (
        _check(
            fit,
            estimate_of(joint, shares[index]),
            estimate_of(joint, total(shares, _others(len(runs), index, odd))),
            len(runs),
        )
        for index, fit in enumerate(fits)
    )
    return tuple(
        replace(check, set_aside=i in aside, own_effects=tuple(sorted(aside.get(i, ()))))
        for i, check in enumerate(checks)
    )


def odd_runs(joint: Fit, runs: Sequence[Run]) -> frozenset[int]:
    """Return which runs disagree with all others."""
    return disagreeing(joint, *_each_alone(joint, runs))


def _each_alone(joint: Fit, runs: Sequence[Run]) -> tuple[list[Fit], list[Share]]:
    fits = [alone(joint, s) for s in restarted(joint.model, whole(runs))]
    return fits, [share_of(fit) for fit in fits]


def alone(joint: Fit, stretch: Stretch) -> Fit:
    """Fit one run on its own, from the joint fit on."""
    return fit_with_noise_held(joint.space, (stretch,), joint.u, joint.gains, EVALUATIONS)


def share_of(fit: Fit) -> Share:
    """Return what one run says; the spread is taken about its mean, zero where it converged."""
    jacobian = fit.jacobian[..., : len(fit.u)]
    scores = block_scores(jacobian, fit.whitened)
    centred = scores - scores.mean(axis=0)
    information = np.einsum('nap,naq->pq', jacobian, jacobian)
    spread = centred.T @ centred * BLOCKS / (BLOCKS - 1)
    astray = information @ wandering(fit, jacobian) @ information
    return Share(information, information @ fit.u - scores.sum(axis=0), spread + astray)


def total(shares: Sequence[Share], chosen: Sequence[int]) -> Share:
    """Return what several runs say together."""
    return reduce(add, (shares[index] for index in chosen))


def estimate_of(joint: Fit, share: Share) -> Estimated:
    """Return what runs say together, with a weak pull towards the joint fit."""
    bread = np.linalg.pinv(share.information + np.eye(len(joint.u)))
    u = np.clip(bread @ (share.weighted + joint.u), *joint.space.bounds())
    return Estimated(u, bread @ share.spread @ bread)


def disagreeing(
    joint: Fit, fits: Sequence[Fit], shares: Sequence[Share], known: frozenset[int] = frozenset()
) -> frozenset[int]:
    """Return which runs disagree, after those known to: one by one, whose going helps the most.

    So a run that spoils what the others say does not make them look wrong, however little it says
    itself. Where the last two disagree with each other nobody can say which is wrong: all are
    returned.
    """

    def agreed(left: frozenset[int]) -> float:
        least = 1.0
        for index in sorted(left):
            own = estimate_of(joint, shares[index])
            others = estimate_of(joint, total(shares, sorted(left - {index})))
            least = min(least, float(chances(fits[index], own, others, len(fits)).min()))
        return least

    everyone = frozenset(range(len(fits)))
    left = everyone - known
    while len(left) > 1 and agreed(left) < LEVEL:
        if len(left) == 2:
            return everyone
        left = max((left - {index} for index in sorted(left)), key=agreed)
    return everyone - left


def chances(fit: Fit, own: Estimated, others: Estimated, count: int) -> Array:
    """Return the chance of so large a difference in each parameter, one of so many runs.

    Two tests must agree. Intervals are robust against serial correlation; but what hangs on a few
    events (a stop, a start) has too narrow ones, so the likelihood must fall too.
    """
    fall = likelihood_chance(fit, others.u) * count
    return np.minimum(1.0, np.maximum(interval_chances(own, others) * count * len(own.u), fall))


def interval_chances(own: Estimated, others: Estimated) -> Array:
    """Return each parameter's chance by its intervals; 1 where the difference is no matter."""
    difference = np.abs(own.u - others.u)
    deviation = np.sqrt(np.maximum(np.diag(own.covariance + others.covariance), 0.0))
    matters = difference > IMMATERIAL * np.maximum(1.0, np.abs(others.u))
    score = np.where(matters, difference / np.maximum(deviation, 1e-12), 0.0)
    return np.asarray(2.0 * stats.t.sf(score, BLOCKS - 1))


def likelihood_chance(fit: Fit, u: Array) -> float:
    """Return the chance of what a run's robust likelihood loses by parameters not its own."""
    loss = replace(fit, u=u).deviance(fit.sigma) - fit.deviance(fit.sigma)
    return float(stats.chi2.sf(max(loss, 0.0), len(u)))


def _others(count: int, index: int, aside: frozenset[int]) -> list[int]:
    """Return the other runs; those set aside are heard only where no other is left."""
    others = set(range(count)) - {index}
    return sorted(others - aside or others)


def _check(fit: Fit, own: Estimated, others: Estimated, count: int) -> RunCheck:
    """Describe one run: its error with the parameters of the others, and what differs."""
    (stretch,) = fit.stretches
    predicted = run_free(fit.space.model(others.u), stretch).twist
    chance = chances(fit, own, others, count)
    here, there = (estimates_at(fit.space, *estimated) for estimated in (own, others))
    names = [coordinate.name for coordinate in fit.space.coordinates]
    differences = tuple(
        Difference(names[index], here[names[index]], there[names[index]])
        for index in np.argsort(chance, kind='stable')
        if chance[index] < LEVEL and _disjoint(here[names[index]], there[names[index]])
    )
    floor = noise_floor([stretch.twist], [predicted])
    radius, half = fit.model.robot.wheel_radius, fit.model.half_separation
    right, left = wheel_speeds(*stretch.run.rolled, half)
    angles = (right / radius, left / radius)
    error = norm(stretch.twist - predicted)
    return RunCheck(stretch.run.name, error, floor, differences, wheel_angles=angles)


def _disjoint(here: Estimate, there: Estimate) -> bool:
    """Tell whether intervals are disjoint: mu_static is fitted as an excess, which may differ."""
    return here.low > there.high or there.low > here.high
