"""Whether a robot moves as it is driven at all, before its model is blamed for anything finer."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.fitting.wiring import Fault
from diffbot_sim.identification.found import Found
from diffbot_sim.identification.free_forms.otherwise import force_over_time
from diffbot_sim.identification.recordings.free_running import run_free
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.result import Structure
from diffbot_sim.identification.statistics.norms import rms_of_each

# A simulation whose errors are no less than this share of the motion explains none of it.
NONE = 0.9
# A robot that is moving where a stretch begins coasts, which is no merit of the forces [s].
COASTING = 5.0


def follows_nothing(fit: Fit, held_out: Sequence[Stretch]) -> Structure | None:
    """Return the force that drives a robot whose motion follows no command, if that is so.

    Neither where it was fitted nor in held-out data: clocks, topics or units are to be suspected.
    """
    if any(explains(fit, stretches) for stretches in (fit.stretches, held_out)):
        return None
    words = (
        'that moves it otherwise than the recorded forces do, which explain none of the motion: '
        'look at clocks, topics and units'
    )
    return force_over_time(fit, held_out[0], 0, words)


def moved_as_if(fault: Fault, found: Found) -> Structure:
    """Return the force that drives a robot whose recording has a fault, told by the fault."""
    force = force_over_time(found.selection.final, found.held_out[0], fault.axes[0], '')
    words = f'the robot moves as if {fault.words}: look at topics, signs, units and clocks'
    return replace(force, description=words)


def explains(fit: Fit, stretches: Sequence[Stretch]) -> bool:
    """Say whether a free-running simulation errs less than one that stands still, in v or ω."""
    later = [stretch.time >= stretch.time[0] + COASTING for stretch in stretches]
    told = [run_free(fit.model, stretch).twist for stretch in stretches]
    pairs = zip(stretches, told, later, strict=True)
    errors = np.concatenate([(s.twist - t)[counts] for s, t, counts in pairs])
    motion = np.concatenate([s.twist[counts] for s, counts in zip(stretches, later, strict=True)])
    if not motion.size:
        return True
    left, all_of_it = (rms_of_each(x) for x in (errors, motion))
    return bool(np.any(left < NONE * all_of_it))
