"""Where the wheels of each run stand as it begins: what hangs on their angle tells it.

Encoders count from where they are switched on, and so does each bag. Where a ripple of one run is
found in another, it is the same one only if the wheels are taken to begin elsewhere in their turn.
"""

from collections.abc import Sequence
from dataclasses import replace
from itertools import product
from math import pi

import numpy as np
from scipy.optimize import least_squares

from diffbot_sim.identification.fitting.fit import Fit, fit_prediction, whitened
from diffbot_sim.identification.found import Found
from diffbot_sim.identification.recordings.recordings import Recordings
from diffbot_sim.identification.recordings.start import restarted
from diffbot_sim.identification.recordings.stretches import Stretch, whole
from diffbot_sim.identification.statistics.guards import VERY_STRONG
from diffbot_sim.identification.statistics.robust import HUBER, huber
from diffbot_sim.physics.effects.wheel_ripple import WheelRipple
from diffbot_sim.physics.kinematics import body_twist
from diffbot_sim.records import Array

# Angles of each wheel, in parts of a period, that are tried first.
PARTS = 8
NOWHERE = (0.0, 0.0)


def standing(found: Found) -> Recordings | None:
    """Return recordings whose wheels begin where a ripple says, nothing where it says nothing.

    The first run that is learned from tells the ripple; each other one, where its wheels stood.
    That is asked once.
    """
    recordings, final = found.recordings, found.selection.final
    is_known = any(any(run.rolled) for run in recordings.all)
    if WheelRipple.name not in found.names or len(recordings.all) < 2 or is_known:
        return None
    stretches = restarted(final.model, whole(recordings.all))
    first = min(set(range(len(recordings.learned))) - recordings.aside)
    told = fit_prediction(final.space, (stretches[first],), final.u, final.gains)
    rolled = [_rolled(told, s) if s is not stretches[first] else NOWHERE for s in stretches]
    return recordings.rolled(rolled) if any(map(any, rolled)) else None


def _rolled(told: Fit, stretch: Stretch) -> tuple[float, float]:
    """Return way [m] and turn [rad] before a stretch for which a fit to another one holds best."""
    (ripple,) = (e for e in told.model.effects if isinstance(e, WheelRipple))
    radius, half = told.model.robot.wheel_radius, told.model.half_separation

    def rolled(parts: Array) -> tuple[float, float]:
        right, left = (2.0 * pi * radius / ripple.order * float(part) for part in parts)
        return body_twist(right, left, half)

    def errors(parts: Array) -> Array:
        there = moved(stretch, rolled(parts))
        return whitened((there,), told.model, told.gains, told.sigma).ravel()

    grid = [np.array(it) / PARTS for it in product(range(PARTS), repeat=2)]
    best = min(grid, key=lambda parts: huber(errors(parts)).sum())
    best = least_squares(errors, best, loss='huber', f_scale=HUBER, diff_step=1e-4, max_nfev=10).x
    as_it_was, better = (float(huber(errors(at)).sum()) for at in (np.zeros(2), best))
    price = 2.0 * float(np.log(2 * np.count_nonzero(stretch.used))) + VERY_STRONG
    return rolled(best) if as_it_was - better > price else NOWHERE


def moved(stretch: Stretch, rolled: Sequence[float]) -> Stretch:
    """Return a stretch whose wheels have rolled a way [m] and a turn [rad] more before it."""
    way, turn = rolled
    start = replace(
        stretch.start,
        travelled=stretch.start.travelled + way,
        turned=stretch.start.turned + turn,
    )
    return replace(stretch, way=stretch.way + np.array([way, turn]), start=start)
