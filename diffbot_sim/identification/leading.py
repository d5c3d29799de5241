"""Forces that act before their stamps: found by likelihood, and put back.

A force that is measured is often stamped when it is published, a moment after it acted. A robot
that is late is told as an effect; that it moves ahead of its forces no effect can be.
"""

from dataclasses import replace
from math import log

from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.recordings.acting import acted_before
from diffbot_sim.identification.selection.candidates import begun_anew
from diffbot_sim.identification.selection.evidence import likelihood_ratio
from diffbot_sim.identification.selection.screening import Screen
from diffbot_sim.identification.statistics.guards import VERY_STRONG
from diffbot_sim.identification.statistics.minimisation import flatter

# What leads by so long [s] is no matter of stamps; by how little a lead is moved to see what that
# does, and how closely it is looked for.
LONGEST, NUDGE, CLOSELY = 0.1, 5e-4, 1e-4
ROUNDS = 5
# A lead that promises less than this share of what it must explain is not looked for.
HOPEFUL = 0.2


def lead_of(fit: Fit) -> float:
    """Return by how much forces act before their stamps [s], 0 where that is not sure."""
    least = log(fit.whitened.size) + VERY_STRONG
    promised, step = _step(fit)
    if step <= 0.0 or promised < HOPEFUL * least:
        return 0.0
    lead, led = 0.0, fit
    for _ in range(ROUNDS):
        ahead = min(lead + step, LONGEST)
        if ahead <= 0.0:
            return 0.0
        if abs(ahead - lead) < CLOSELY:
            break
        lead, led = ahead, led_by(fit, ahead)
        _, step = _step(led)
    return lead if lead < LONGEST and likelihood_ratio(fit, led) > least else 0.0


def led_by(fit: Fit, lead: float) -> Fit:
    """Fit a structure again to forces that act so long before their stamps [s]."""
    return begun_anew(_moved(fit, lead))


def _moved(fit: Fit, lead: float) -> Fit:
    """Return a fit as it is on forces that act so long before their stamps."""
    moved = tuple(replace(s, run=acted_before(s.run, lead)) for s in fit.stretches)
    return replace(fit, stretches=moved)


def _step(fit: Fit) -> tuple[float, float]:
    """Return what more lead explains, and how much more it is, to first order.

    Beside all that is fitted: a fall of the deviance, and a time [s].
    """
    later, earlier = (_moved(fit, nudge).whitened for nudge in (-NUDGE, NUDGE))
    # Where a wheel starts or stops errors jump: that lies on one side and is no slope.
    slope = flatter(earlier - fit.whitened, fit.whitened - later) / NUDGE
    promised, (step,), _ = Screen(fit).explained(slope[..., None])
    return promised, float(step)
