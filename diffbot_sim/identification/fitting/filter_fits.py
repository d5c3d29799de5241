"""Fits of a structure together with a filter of the twists, or with a colour of the noise."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from scipy.signal import lfilter

from diffbot_sim.identification.fitting.coordinates import Space, point_of
from diffbot_sim.identification.fitting.fit import (
    EVALUATIONS,
    FIRST_GAINS,
    innovations,
    joint_bounds,
    joint_prior,
)
from diffbot_sim.identification.fitting.predictor import NO_GAIN
from diffbot_sim.identification.fitting.standing_noise import polynomials
from diffbot_sim.identification.recordings.filters import SecondOrder, as_let_through, before
from diffbot_sim.identification.recordings.lateness import lateness_of
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.statistics.memory import deviance_beyond_past
from diffbot_sim.identification.statistics.minimisation import Bounds, Errors, Prior, minimise
from diffbot_sim.physics.effects import Effect
from diffbot_sim.records import Array

# Rounds of the fits that are compared.
ROUNDS = 4
# How old what a filter is told may be, in intervals of the odometry, and where fits of it begin.
OLDEST, OLD = np.array([1.2]), np.array([0.3])
# How far the numbers of a filter may go, and how far from where they begin they may well be.
FARTHEST, DEVIATION = 3.5, 5.0


@dataclass(frozen=True)
class Ended:
    """Where a fit with a filter, or with a colour of the noise, ended.

    cost: -2 log-likelihood; u: point of the structure; numbers: of the filter or the colour; age:
    of what a filter is told, in intervals.
    """

    structure: 'Behind'
    cost: float
    u: Array
    numbers: Array
    age: float = 0.0

    @property
    def filter(self) -> SecondOrder:
        """The filter."""
        return self.structure.filter(self.numbers, self.age)

    @property
    def undone(self) -> list[Stretch]:
        """The stretches, their twists as the filter let them through at once."""
        return [as_let_through(s, self.filter) for s in self.structure.stretches]

    @property
    def delay(self) -> float:
        """How late twists are by the filter [s]."""
        return self.filter.lateness(self.structure.interval)

    @property
    def lateness(self) -> float:
        """How late twists are [s]: by the robot, and by the filter."""
        return lateness_of(self.structure.space.values(self.u)) + self.delay

    @property
    def bic(self) -> float:
        """The cost, with what numbers cost."""
        samples = sum(int(stretch.used.sum()) for stretch in self.structure.stretches)
        return self.cost + (len(self.u) + len(self.numbers)) * float(np.log(2 * samples))


@dataclass(frozen=True)
class Behind:
    """Effects, at a point, on stretches behind a filter that is not known yet."""

    space: Space
    u: Array
    stretches: tuple[Stretch, ...]

    @property
    def interval(self) -> float:
        """The time between samples [s]."""
        return self.stretches[0].interval

    def filter(self, numbers: Array, age: float) -> SecondOrder:
        """Return the filter that numbers stand for; age: of what it is told, in intervals."""
        past, given = (tuple(map(float, by)) for by in polynomials(numbers))
        return SecondOrder(past, given, self.interval, age * self.interval)

    def with_late(self, late: float, kind: type[Effect]) -> 'Behind':
        """Return the same with an effect that makes the robot late, by so much [s] at first."""
        space = Space(self.space.declared, (*self.space.kinds, kind))
        return replace(self, space=space, u=np.append(self.u, point_of(kind, (late,))))

    def filtered(self, numbers: Array) -> Ended:
        """Fit it with a filter that begins at some numbers."""
        ends = np.cumsum([len(self.u), len(NO_GAIN), len(numbers)])

        def errors(at: Array) -> Array:
            u, gains, own, age = np.split(at, ends)
            behind = self.filter(own, float(age[0]))
            undone = [before(stretch, behind) for stretch in self.stretches]
            missed = innovations(undone, self.space.model(u), gains)
            return missed * behind.at_once(self.interval)

        at, cost = fitted(errors, [self._block, _of_filter(numbers), OF_AGE])
        u, _, own, age = np.split(at, ends)
        return Ended(self, cost, u, own, float(age[0]))

    def coloured(self, numbers: Array) -> Ended:
        """Fit it to twists as they are, whose errors have a colour that begins at some numbers."""
        ends = np.cumsum([len(self.u), len(NO_GAIN)])
        counts = np.cumsum([stretch.used.sum() for stretch in self.stretches])[:-1]

        def errors(at: Array) -> Array:
            u, gains, own = np.split(at, ends)
            past, given = polynomials(own)
            missed = innovations(self.stretches, self.space.model(u), gains)
            parts = np.split(missed, counts)
            return np.concatenate([lfilter(past, given, of, axis=0) for of in parts])

        at, cost = fitted(errors, [self._block, _of_filter(numbers)])
        u, _, own = np.split(at, ends)
        return Ended(self, cost, u, own)

    @property
    def _block(self) -> 'Block':
        return of_structure(self.space, self.u, FIRST_GAINS)


class Block(NamedTuple):
    """Some of the numbers of a fit: where they begin, what is known of them, how far they go."""

    start: Array
    prior: Prior
    bounds: Bounds


def of_structure(space: Space, u: Array, gains: Array) -> Block:
    """Return the numbers of a structure, and the gains, as they begin a fit."""
    return Block(np.concatenate([u, gains]), joint_prior(space), joint_bounds(space))


def _of_filter(numbers: Array) -> Block:
    far = np.full(len(numbers), FARTHEST)
    return Block(numbers, Prior(numbers, np.full(len(numbers), DEVIATION)), (-far, far))


# Of a robot that is delayed nothing tells how old that is: most filters are told each sample.
OF_AGE = Block(OLD, Prior(np.zeros(1), np.ones(1)), (np.zeros(1), OLDEST))


def fitted(errors: Errors, blocks: Sequence[Block]) -> tuple[Array, float]:
    """Fit numbers by robust least squares; return the point and -2 log-likelihood."""
    starts, priors, bounds = zip(*blocks, strict=True)
    prior = Prior(*map(np.concatenate, zip(*priors, strict=True)))
    low, high = map(np.concatenate, zip(*bounds, strict=True))
    at, sigma = minimise(errors, np.concatenate(starts), prior, (low, high), EVALUATIONS, ROUNDS)
    return at, deviance_beyond_past(errors(at) / sigma, sigma)
