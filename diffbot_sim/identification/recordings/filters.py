"""Filters that twists went through on their way into a bag, and what they were given."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import NamedTuple, Protocol

import numpy as np
from scipy.signal import lfilter, lfilter_zi
from scipy.special import exprel

from diffbot_sim.identification.recordings.intervals import median_interval
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.records import Array, Run

# How old [s] what a filter of a time constant is given is, at an interval of the odometry.
Age = Callable[[float, float], float]


class Filter(Protocol):
    """A low-pass filter of twists."""

    def lateness(self, interval: float) -> float:
        """Return by how much it delays what changes slowly [s], at an interval of the odometry."""

    def at_once(self, interval: float) -> float:
        """Return the share of a change that it lets through at once, at an interval of that."""

    def undone(self, time: Array, twist: Array) -> tuple[Array, Array]:
        """Return the stamps and twists that it was given; the first sample as it is."""


def unfiltered(run: Run, behind: Filter) -> Run:
    """Return a run whose twists, and their stamps, are those that a filter was given."""
    seen = run.odometry
    time, twist = behind.undone(seen.time, seen.twist)
    return replace(run, odometry=replace(seen, time=time, twist=twist))


def before(stretch: Stretch, behind: Filter) -> Stretch:
    """Return a stretch whose twists, and their stamps, are those that a filter was given."""
    time, twist = behind.undone(stretch.time, stretch.twist)
    return replace(stretch, time=time, twist=twist)


def as_let_through(stretch: Stretch, behind: Filter) -> Stretch:
    """Return a stretch whose twists are what a filter let through at once of what it was given.

    Of white noise that is what was new at each sample.
    """
    given = before(stretch, behind)
    return replace(given, twist=behind.at_once(stretch.interval) * given.twist)


def told_each_sample(time_constant: float, interval: float) -> float:
    """Return the age of what a filter is told that is told each sample: of that moment."""
    return 0.0


def told_often(time_constant: float, interval: float) -> float:
    """Return the age of what a filter is told that is told much more often than the odometry.

    It passes a mean over the interval, in which the latest counts most.
    """
    return time_constant * (1.0 - 1.0 / float(exprel(interval / time_constant)))


AGES: tuple[Age, ...] = (told_each_sample, told_often)


class FirstOrder(NamedTuple):
    """A first-order filter: its time constant [s], and how old what it is told is."""

    time_constant: float
    age: Age

    def lateness(self, interval: float) -> float:
        """Return by how much it delays what changes slowly [s], at an interval of the odometry."""
        told = interval / float(np.expm1(interval / self.time_constant))
        return told + self.age(self.time_constant, interval)

    def at_once(self, interval: float) -> float:
        """Return the share of a change that it lets through at once, at an interval of that."""
        return -float(np.expm1(-interval / self.time_constant))

    def undone(self, time: Array, twist: Array) -> tuple[Array, Array]:
        """Return the stamps and twists that it was given; the first sample as it is."""
        passed = passed_at_once(time, self.time_constant)[:, None]
        given = np.vstack([twist[:1], twist[:-1] + np.diff(twist, axis=0) / passed])
        return time - self.age(self.time_constant, median_interval(time)), given


def passed_at_once(time: Array, time_constant: float) -> Array:
    """Return the share of each change that a filter of first order lets through at once."""
    return np.asarray(-np.expm1(-np.diff(time) / time_constant))


@dataclass(frozen=True)
class SecondOrder:
    """A filter of second order that is told each sample: past · y = share · given · u.

    past, given: what counts of the latest three samples that it told and was told, the latest
    first, with 1; share: so much that a steady twist stays what it is. interval [s]: between
    samples; age [s]: how old what it is told is.
    """

    past: tuple[float, ...]
    given: tuple[float, ...]
    interval: float
    age: float

    def at_once(self, interval: float) -> float:
        """Return the share of a change that it lets through at once, whatever the interval."""
        return sum(self.past) / sum(self.given)

    def lateness(self, interval: float) -> float:
        """Return by how much it delays what changes slowly [s], as it is told: at its interval."""
        given, past = (float(np.arange(len(by)) @ by) / sum(by) for by in (self.given, self.past))
        return (given - past) * self.interval + self.age

    def undone(self, time: Array, twist: Array) -> tuple[Array, Array]:
        """Return the stamps and twists that it was given; the first sample as it is."""
        steady = lfilter_zi(self.past, self.given)[:, None] * twist[0]
        given, _ = lfilter(self.past, self.given, twist, axis=0, zi=steady)
        return time - self.age, np.ascontiguousarray(given / self.at_once(self.interval))
