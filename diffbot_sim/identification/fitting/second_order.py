"""Filters of second order: told by the noise of a robot that stands, and fitted with its motion.

Estimators smooth twists by Butterworth's filter, an alpha-beta filter or a Kalman filter. Once one
is undone errors are white and the robot is in time: the same filter must account for both.
"""

from collections.abc import Sequence
from dataclasses import replace
from operator import attrgetter

import numpy as np

from diffbot_sim.identification.fitting.filter_fits import Behind, Ended
from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.fitting.standing_noise import (
    Colour,
    colour_of,
    first_order,
    rests_of,
    standing_noise,
    tells_nothing,
    worth_of,
)
from diffbot_sim.identification.recordings.lateness import LATE_EFFECTS
from diffbot_sim.identification.recordings.start import restarted
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.statistics.guards import BEYOND_ALL, VERY_STRONG
from diffbot_sim.identification.statistics.parallel import side_by_side
from diffbot_sim.physics.effects import Effect
from diffbot_sim.records import Array

# Intervals differ by less than this share of the usual one, but for one in a hundred.
EVEN, MOST = 0.25, 0.99
# How far the numbers of a filter go at most where fits begin; and those of what is past alone.
NEAR, OF_PAST = 2.0, np.array([1.0, 1.0, 0.0, 0.0])
# A filter explains at least this share of what a colour does of the noise of a robot that stands,
# and is ahead of what it is told by no more than this share of an interval.
MOST_OF, EARLY = 0.7, 0.25
# A robot that is late besides is taken to be so by this at least [s], where its fit begins.
LEAST_LATE = 0.02
# The shortest delay, in samples, at which a filter of first order begins to be fitted.
SHORTEST = 0.1


def filter_seen_at_rest(free: Fit, kinds: Sequence[type[Effect]]) -> Ended | None:
    """Return a filter of second order that twists went through, if that is beyond doubt.

    free: the declared model, fitted by simulation: a predictor follows filtered noise, and its
    parameters go astray. kinds: effects that are asked about, for a robot behind a filter may be
    late besides. None where the noise of a robot that stands is white, or is not seen; where a
    filter of first order explains as much, or noise of a colour of its own almost does; and where
    the odometry tells means, or comes unevenly.
    """
    if not _are_even(free.stretches):
        return None
    rests = rests_of(free)
    noise = standing_noise(free.stretches, rests)
    colour = _colour_of(noise)
    if colour is None:
        return None
    plain = Behind(free.space, free.u, restarted(free.model, free.stretches))
    ends = _filtered(plain, colour.point, [kind for kind in kinds if kind.name in LATE_EFFECTS])
    best = min(ends, key=attrgetter('bic'))
    white = standing_noise(best.undone, rests)
    if worth_of(noise, white) < MOST_OF * colour.worth or best.delay < -EARLY * plain.interval:
        return None
    if _of_first_order(best).bic <= best.bic + VERY_STRONG:
        return None
    # On a rough floor noise of a colour is known less well than a filter is.
    others = side_by_side(lambda end: _instead(plain, end).coloured(colour.point), ends)
    return best if best.bic + BEYOND_ALL < min(end.bic for end in others) else None


def with_structure(behind: Ended, final: Fit) -> Ended:
    """Fit a filter again with a structure that was found once it was undone."""
    structure = replace(behind.structure, space=final.space, u=final.u)
    return structure.filtered(behind.numbers)


def _filtered(plain: Behind, colour: Array, late: Sequence[type[Effect]]) -> list[Ended]:
    """Fit a filter to a structure as it is, and with each of the effects that make it late."""
    # Of a short rest what is given may seem to end what is slow: then that is a hollow.
    begun = side_by_side(plain.filtered, (colour, colour * OF_PAST))
    alone = min(begun, key=attrgetter('bic'))
    rest = plain.filter(colour, 0.0).lateness(plain.interval)
    more = max(alone.delay - max(rest, 0.0), LEAST_LATE)
    besides = [replace(plain, u=alone.u).with_late(more, kind) for kind in late]
    return [alone, *side_by_side(lambda other: other.filtered(alone.numbers), besides)]


def _of_first_order(best: Ended) -> Ended:
    """Fit a filter of first order in the place of one of second."""
    structure = replace(best.structure, u=best.u)
    return structure.filtered(first_order(max(best.delay / structure.interval, SHORTEST)))


def _instead(plain: Behind, end: Ended) -> Behind:
    """Return a structure without a filter: its robot is as late as it was with one behind it."""
    late = end.structure.space.kinds[len(plain.space.kinds) :]
    structure = replace(plain, u=end.u[: len(plain.u)])
    return structure.with_late(end.lateness, late[0]) if late else structure


def _colour_of(noise: Sequence[Array]) -> Colour | None:
    """Return the colour of the noise of a robot that stands; None if white, or not seen."""
    if tells_nothing(noise):
        return None
    colour = colour_of(noise)
    price = len(colour.point) * float(np.log(sum(map(np.size, noise))))
    near = np.clip(colour.point, -NEAR, NEAR)
    return colour._replace(point=near) if colour.worth > price + VERY_STRONG else None


def _are_even(stretches: Sequence[Stretch]) -> bool:
    """Say whether twists are of moments, and all as far apart, but for a few."""
    interval = stretches[0].interval
    apart = np.abs(np.concatenate([np.diff(s.time) for s in stretches]) / interval - 1.0)
    means = any(any(stretch.run.odometry.means) for stretch in stretches)
    return not means and bool(np.mean(apart < EVEN) > MOST)
