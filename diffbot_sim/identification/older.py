"""Twists that may be older than their stamps: means since the sample before, as encoders give."""

from collections.abc import Callable, Sequence
from functools import cached_property, partial
from math import log
from typing import NamedTuple

from diffbot_sim.identification.fitting.filtering import filter_behind
from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.leading import led_by
from diffbot_sim.identification.recordings.intervals import median_interval
from diffbot_sim.identification.recordings.lateness import (
    LATE,
    LATE_EFFECTS,
    SPEED,
    TWIST,
    Components,
    lateness_of,
    of_interval_before,
    pose_allows_lag,
    speed_of_interval_before,
)
from diffbot_sim.identification.recordings.recordings import Recordings
from diffbot_sim.identification.selection.candidates import (
    approach,
    complete,
    fit_without,
    on_recordings,
    refitted,
)
from diffbot_sim.identification.selection.evidence import (
    delta_bic,
    delta_bic_beyond_past,
    delta_bic_of_both,
    delta_bic_of_speed,
)
from diffbot_sim.identification.selection.screening import Screen
from diffbot_sim.identification.statistics.guards import VERY_STRONG
from diffbot_sim.identification.statistics.parallel import side_by_side
from diffbot_sim.physics.effects import Effect
from diffbot_sim.records import Run

# What lowers the BIC by so much more needs no search of its own to be believed.
FAR = 100.0
# Beside a force that has no name, less than this share of its worth decides nothing; nor does less
# than all of it where a robot is late by half an interval, as means are, but for this share.
DECIDING_SHARE, AS_MEANS = 0.05, 0.1
# Of a simulator that makes only two steps in an interval means are late by half of that.
HALF_A_STEP = 0.5


class Older(NamedTuple):
    """What of the twists may be older than its stamps.

    what: in words; of: its components; taken: how a run is taken then; worth: how much lower the
    BIC of a second fit is then than that of a first, for what gains less of it; together: the same
    for all of it.
    """

    what: str
    of: Components
    taken: Callable[[Run], Run]
    worth: Callable[[Fit, Fit], float]
    together: Callable[[Fit, Fit], float]


OLDER = (
    Older('twists', TWIST, of_interval_before, delta_bic_of_both, delta_bic_beyond_past),
    # A gyro is never late, and a heading that was made with it says nothing of the speed.
    Older('speeds', SPEED, speed_of_interval_before, delta_bic_of_speed, delta_bic_of_speed),
)


class Ages:
    """How old twists may be, held against a structure that was found as they are stamped."""

    def __init__(self, final: Fit, recordings: Recordings) -> None:
        self._final, self._recordings = final, recordings

    @property
    def likely(self) -> list[Older]:
        """What may be older than its stamps, the likeliest first.

        So it may where the very structure that was found fits better then; and where it may make
        needless that the robot is late by less than an interval, or in two ways at once.
        """
        interval = min(median_interval(run.odometry.time) for run in self._recordings.kept)
        needless = 0.0 < _lateness(self._final) < interval
        fits = self._less_late if needless else self._again
        least = -VERY_STRONG if _ways_late(self._final) > 1 else VERY_STRONG
        told = {
            older: delta_bic_beyond_past(self._final, fit)
            for older, fit in fits.items()
            if needless or older.worth(self._final, fit) > least
        }
        return sorted(told, key=told.__getitem__, reverse=True)

    def beyond_doubt(self, kinds: Sequence[type[Effect]]) -> Older | None:
        """What is the likeliest to be older, if that explains far more than a late robot does."""
        for older in self.likely[:1]:
            if is_beyond_doubt(older, self._again[older], self._recordings, kinds):
                return older
        return None

    def fits(self, older: Older) -> tuple[Fit, ...]:
        """The structure that was found on older twists, as it is and less what makes it late."""
        return self._again[older], self._less_late[older]

    def timely(self, older: Older) -> Fit:
        """Return the structure that was found on older twists, less what makes a robot late.

        The search on these may have ended at a smaller one.
        """
        return self._less_late[older]

    @property
    def is_undecided(self) -> bool:
        """Whether older twists would explain all as well by a robot that is less late."""
        late = _lateness(self._final)
        return late > 0.0 and any(
            o.worth(self._final, fit) > -VERY_STRONG and _lateness(fit) < late
            for o, fit in self._again.items()
        )

    @cached_property
    def _taken(self) -> dict[Older, Fit]:
        """The structure as it was found, on twists that are taken as older, if poses allow it."""
        return {
            older: on_recordings(self._final, self._recordings.each(older.taken))
            for older in OLDER
            if self._is_allowed(older)
        }

    def _is_allowed(self, older: Older) -> bool:
        """Say whether poses allow it of all that are not means beyond doubt, if any are not."""
        unsure = [run for run in self._recordings.all if not all(run.odometry.means)]
        return bool(unsure) and all(pose_allows_lag(run, older.of) for run in unsure)

    @cached_property
    def _less_late(self) -> dict[Older, Fit]:
        """The same, less what makes a robot late."""
        return dict(zip(self._taken, side_by_side(_timely, self._taken.values()), strict=True))

    @cached_property
    def _again(self) -> dict[Older, Fit]:
        """The structure as it was found, fitted again."""
        return dict(zip(self._taken, side_by_side(refitted, self._taken.values()), strict=True))


def is_taken(older: Older, first: Fit, second: Fit, unexplained: float) -> bool:
    """Say whether twists are older than their stamps, by a second fit that takes them so.

    It must be clearly better than the first, of speed and of turn rate; or as good in all, if its
    robot is late in fewer ways.
    unexplained: worth of a force that has no name, beside which worths are known so much worse.
    """
    if older.worth(first, second) > VERY_STRONG:
        return True
    as_good = _as_good(first, second, unexplained)
    return _is_simpler(first, second) and older.together(first, second) > as_good


def lead_of_means(older: Older, first: Fit, second: Fit, unexplained: float) -> float:
    """Return by how much less than half an interval [s] means are late, 0 where that is not sure.

    Those over the steps of a simulator are so by half a step: as if forces acted that much before
    their stamps. With these the second fit, which takes twists as means, must be as good as the
    first, of a robot that is late; with steps that are not short, clearly better.
    """
    half = _half_interval(first)
    lead = half - (_lateness(first) - _lateness(second))
    if not (0.0 < lead <= HALF_A_STEP * half and _is_simpler(first, second)):
        return 0.0
    worth = older.together(first, led_by(second, lead)) - log(second.whitened.size)
    short = _is_of_means(first, second)
    enough = _as_good(first, second, unexplained) if short else VERY_STRONG
    return lead if worth > enough else 0.0


def _is_simpler(first: Fit, second: Fit) -> bool:
    return _ways_late(second) < _ways_late(first)


def _as_good(first: Fit, second: Fit, unexplained: float) -> float:
    """Return the worth beyond which a simpler second fit is as good as the first."""
    share = 1.0 if _is_of_means(first, second) else DECIDING_SHARE
    return -max(VERY_STRONG, share * unexplained)


def is_beyond_doubt(
    older: Older, final: Fit, recordings: Recordings, kinds: Sequence[type[Effect]]
) -> bool:
    """Say whether a fit that takes twists as older is far better than as they are stamped.

    Then the same structure is held against it, of a robot that is late besides, or a filter.
    """
    late = _late_as_stamped(final, recordings, kinds)
    if older.worth(late, final) <= FAR:
        return False
    behind = filter_behind(late)
    return behind is None or not behind.outdoes(late, final)


def _late_as_stamped(final: Fit, recordings: Recordings, kinds: Sequence[type[Effect]]) -> Fit:
    """Fit a structure to twists as they are stamped, and a robot that is late besides."""
    fit = refitted(on_recordings(final, recordings))
    late = [k for k in kinds if k.name in LATE_EFFECTS and k not in fit.space.kinds]
    screen = Screen(fit)
    fits = [complete(approach(screen, kind)) for kind in late]
    return max(fits, key=partial(delta_bic, fit), default=fit)


def _ways_late(fit: Fit) -> int:
    values = fit.space.values(fit.u)
    return sum(values.get(name, 0.0) > 0.0 for name in LATE)


def _is_of_means(first: Fit, second: Fit) -> bool:
    """Say whether the first robot is later than the second by half an interval of its twists."""
    half = _half_interval(first)
    return abs(_lateness(first) - _lateness(second) - half) < AS_MEANS * half


def _half_interval(fit: Fit) -> float:
    return 0.5 * min(median_interval(stretch.time) for stretch in fit.stretches)


def _lateness(fit: Fit) -> float:
    return lateness_of(fit.space.values(fit.u))


def _timely(fit: Fit) -> Fit:
    """Fit a structure again, less what makes a robot late."""
    present = {kind.name for kind in fit.space.kinds}
    return fit_without(fit, *present.intersection(LATE_EFFECTS))
