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
    colour_of,
    first_order,
    standing_noise,
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
    colour = _colour_at_rest(free)
    if colour is None:
        return None
    plain = Behind(free.space, free.u, restarted(free.model, free.stretches))
    ends = _filtered(plain, colour, [kind for kind in kinds if kind.name in LATE_EFFECTS])
    best = min(ends, key=attrgetter('bic'))
    if _of_first_order(best).bic <= best.bic + VERY_STRONG:
        return None
    # On a rough floor noise of a colour is known less well than a filter is.
    noise = side_by_side(lambda end: _instead(plain, end).coloured(colour), ends)
    return best if best.bic + BEYOND_ALL < min(end.bic for end in noise) else None


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


def _colour_at_rest(free: Fit) -> Array | None:
    """Return the numbers of the colour that noise has while the robot stands; None if white."""
    interval = free.stretches[0].interval
    even = all(_is_even(stretch, interval) for stretch in free.stretches)
    rests = standing_noise(free) if even else []
    if not rests:
        return None
    colour = colour_of(rests)
    price = len(colour.point) * float(np.log(sum(map(np.size, rests))))
    return np.clip(colour.point, -NEAR, NEAR) if colour.worth > price + VERY_STRONG else None


def _is_even(stretch: Stretch, interval: float) -> bool:
    """Say whether twists of a stretch are of moments, so far apart [s] but for a few."""
    apart = np.abs(np.diff(stretch.time) / interval - 1.0)
    return not any(stretch.run.odometry.means) and bool(np.mean(apart < EVEN) > MOST)
