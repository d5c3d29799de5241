"""Filters of second order: told by the noise of a robot that stands, and fitted with its motion.

Estimators smooth twists by Butterworth's filter, an alpha-beta filter or a Kalman filter. Once one
is undone errors are white and the robot is in time: the same filter must account for both.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from operator import attrgetter
from typing import NamedTuple

import numpy as np
from scipy.signal import lfilter

from diffbot_sim.identification.fitting.coordinates import Space, point_of
from diffbot_sim.identification.fitting.fit import (
    FIRST_GAINS,
    UNIT,
    Fit,
    joint_bounds,
    joint_prior,
    whitened,
)
from diffbot_sim.identification.fitting.predictor import NO_GAIN
from diffbot_sim.identification.fitting.standing_noise import (
    colour_of,
    polynomials,
    standing_noise,
)
from diffbot_sim.identification.recordings.filters import SecondOrder, before
from diffbot_sim.identification.recordings.lateness import LATE_EFFECTS
from diffbot_sim.identification.recordings.start import restarted
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.statistics.guards import VERY_STRONG
from diffbot_sim.identification.statistics.memory import unforeseen
from diffbot_sim.identification.statistics.minimisation import Bounds, Errors, Prior, minimise
from diffbot_sim.identification.statistics.parallel import side_by_side
from diffbot_sim.physics.effects import Effect
from diffbot_sim.records import Array

# Intervals differ by less than this share of the usual one, but for one in a hundred.
EVEN, MOST = 0.25, 0.99
# Rounds of the fits that are compared, and evaluations in each.
ROUNDS, EVALUATIONS = 4, 10
# How old what a filter is told may be, in intervals of the odometry, and where fits of it begin.
OLDEST, OLD = np.array([1.2]), np.array([0.3])
# How far the numbers of a filter may go, and how far from where they begin they may well be.
FARTHEST, DEVIATION = 3.5, 5.0
# How far they go at most where fits begin; and those of what is past alone.
NEAR, OF_PAST = 2.0, np.array([1.0, 1.0, 0.0, 0.0])
# A robot that is late besides is taken to be so by this at least [s], where its fit begins.
LEAST_LATE = 0.02


@dataclass(frozen=True)
class _End:
    """Where a fit with a filter, or with a colour of the noise, ended.

    cost: -2 log-likelihood; u: point of the structure; numbers: of the filter or the colour; age:
    of what a filter is told, in intervals.
    """

    structure: '_Structure'
    cost: float
    u: Array
    numbers: Array
    age: float = 0.0

    @property
    def filter(self) -> SecondOrder:
        """The filter."""
        return self.structure.filter(self.numbers, self.age)

    @property
    def bic(self) -> float:
        """The cost, with what numbers cost."""
        samples = sum(int(stretch.used.sum()) for stretch in self.structure.stretches)
        return self.cost + (len(self.u) + len(self.numbers)) * float(np.log(2 * samples))


@dataclass(frozen=True)
class _Structure:
    """Effects, at a point, on stretches behind a filter that is not known yet."""

    space: Space
    u: Array
    stretches: tuple[Stretch, ...]

    def filter(self, numbers: Array, age: float) -> SecondOrder:
        """Return the filter that numbers stand for; age: of what it is told, in intervals."""
        past, given = (tuple(map(float, by)) for by in polynomials(numbers))
        interval = self.stretches[0].interval
        return SecondOrder(past, given, interval, age * interval)

    def with_late(self, late: float, kind: type[Effect]) -> '_Structure':
        """Return the same with an effect that makes the robot late, by so much [s] at first."""
        space = Space(self.space.declared, (*self.space.kinds, kind))
        return replace(self, space=space, u=np.append(self.u, point_of(kind, (late,))))

    def filtered(self, numbers: Array) -> _End:
        """Fit it with a filter that begins at some numbers."""
        ends = np.cumsum([len(self.u), len(NO_GAIN), len(numbers)])

        def errors(at: Array) -> Array:
            u, gains, own, age = np.split(at, ends)
            behind = self.filter(own, float(age[0]))
            undone = [before(stretch, behind) for stretch in self.stretches]
            return whitened(undone, self.space.model(u), gains, UNIT) * behind.at_once

        at, cost = _fitted(errors, [self._block, _of_filter(numbers), OF_AGE])
        u, _, own, age = np.split(at, ends)
        return _End(self, cost, u, own, float(age[0]))

    def coloured(self, numbers: Array) -> _End:
        """Fit it to twists as they are, whose errors have a colour that begins at some numbers."""
        ends = np.cumsum([len(self.u), len(NO_GAIN)])
        counts = np.cumsum([stretch.used.sum() for stretch in self.stretches])[:-1]

        def errors(at: Array) -> Array:
            u, gains, own = np.split(at, ends)
            past, given = polynomials(own)
            missed = whitened(self.stretches, self.space.model(u), gains, UNIT)
            parts = np.split(missed, counts)
            return np.concatenate([lfilter(past, given, of, axis=0) for of in parts])

        at, cost = _fitted(errors, [self._block, _of_filter(numbers)])
        u, _, own = np.split(at, ends)
        return _End(self, cost, u, own)

    @property
    def _block(self) -> '_Block':
        start = np.concatenate([self.u, FIRST_GAINS])
        return _Block(start, joint_prior(self.space), joint_bounds(self.space))


class _Block(NamedTuple):
    """Some of the numbers of a fit: where they begin, what is known of them, how far they go."""

    start: Array
    prior: Prior
    bounds: Bounds


def _of_filter(numbers: Array) -> _Block:
    far = np.full(len(numbers), FARTHEST)
    return _Block(numbers, Prior(numbers, np.full(len(numbers), DEVIATION)), (-far, far))


OF_AGE = _Block(OLD, Prior(OLD, np.ones(1)), (np.zeros(1), OLDEST))


def _fitted(errors: Errors, blocks: Sequence[_Block]) -> tuple[Array, float]:
    """Fit numbers by robust least squares; return the point and -2 log-likelihood."""
    starts, priors, bounds = zip(*blocks, strict=True)
    prior = Prior(*map(np.concatenate, zip(*priors, strict=True)))
    low, high = map(np.concatenate, zip(*bounds, strict=True))
    at, sigma = minimise(errors, np.concatenate(starts), prior, (low, high), EVALUATIONS, ROUNDS)
    white = errors(at) / sigma
    return at, len(white) * float(np.log(unforeseen(white) * sigma**2).sum())


def second_order_behind(free: Fit, kinds: Sequence[type[Effect]]) -> SecondOrder | None:
    """Return a filter of second order that twists went through, if that is beyond doubt.

    free: the declared model, fitted by simulation: a predictor follows filtered noise, and its
    parameters go astray. kinds: effects that are asked about, for a robot behind a filter may be
    late besides. None where the noise of a robot that stands is white, or is not seen; where a
    filter of first order explains as much, or noise of a colour of its own does; and where the
    odometry tells means, or comes unevenly.
    """
    colour = _colour_at_rest(free)
    if colour is None:
        return None
    plain = _Structure(free.space, free.u, restarted(free.model, free.stretches))
    # Of a short rest what is given may seem to end what is slow: then that is a hollow.
    begun = side_by_side(plain.filtered, (colour, colour * OF_PAST))
    alone = min(begun, key=attrgetter('bic'))
    rest = max(plain.filter(colour, 0.0).lateness, 0.0)
    late = max(alone.filter.lateness - rest, LEAST_LATE)
    others = [
        replace(plain, u=alone.u).with_late(late, k) for k in kinds if k.name in LATE_EFFECTS
    ]
    ends = side_by_side(lambda other: other.filtered(alone.numbers), others)
    best = min((alone, *ends), key=attrgetter('bic'))
    simple = replace(best.structure, u=best.u).filtered(colour[:1])
    if simple.bic <= best.bic + VERY_STRONG:
        return None
    noise = side_by_side(lambda other: other.coloured(colour), (plain, *others))
    return best.filter if best.bic + VERY_STRONG < min(end.bic for end in noise) else None


def _colour_at_rest(free: Fit) -> Array | None:
    """Return the numbers of the colour that noise has while the robot stands; None if white."""
    rests = standing_noise(free) if all(map(_is_even, free.stretches)) else []
    if not rests:
        return None
    colour = colour_of(rests)
    price = len(colour.point) * float(np.log(sum(map(np.size, rests))))
    return np.clip(colour.point, -NEAR, NEAR) if colour.worth > price + VERY_STRONG else None


def _is_even(stretch: Stretch) -> bool:
    """Say whether twists of a stretch are of moments that are evenly apart, but for a few."""
    interval = np.diff(stretch.time) / stretch.interval
    return not any(stretch.run.odometry.means) and bool(
        np.mean(np.abs(interval - 1.0) < EVEN) > MOST
    )
