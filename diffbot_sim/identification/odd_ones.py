"""Runs of another condition than the others: which these are, and what they have of their own."""

from collections.abc import Sequence

import numpy as np

from diffbot_sim.identification.conclusions.agreement import odd_runs
from diffbot_sim.identification.fitting.coordinates import Space
from diffbot_sim.identification.fitting.fit import Fit, fit_prediction, whitened
from diffbot_sim.identification.found import Found
from diffbot_sim.identification.recordings.start import restarted
from diffbot_sim.identification.recordings.stretches import whole
from diffbot_sim.identification.statistics.robust import influence
from diffbot_sim.identification.suspicion import SUSPICIOUS
from diffbot_sim.physics.effects import Effect
from diffbot_sim.records import Run

# Squared errors over those of most runs. On a slope of two percent they are 1.15; runs that are
# taken for odd by mistake only cost the time to see that.
WORSE = 1.1


def odd_among(found: Found) -> frozenset[int]:
    """Return which runs disagree with the others, where something is said of them together.

    As long as the others are more. Where their parameters are alike, those that are explained
    worse: what acts in one of several runs, a slope under it, the noise model follows there.
    """
    runs, final = found.recordings.learned, found.selection.final
    # Of two runs nobody can say which is odd.
    if not found.says_something or len(runs) < 3:
        return frozenset()
    odd = (ask(final, runs) for ask in (odd_runs, _explained_worse))
    return next((few for few in odd if 0 < 2 * len(few) < len(runs)), frozenset())


def _explained_worse(fit: Fit, runs: Sequence[Run]) -> frozenset[int]:
    """Return which runs a fit explains clearly worse than it does most."""
    stretches = restarted(fit.model, whole(runs))
    errors = (whitened((it,), fit.model, fit.gains, fit.sigma) for it in stretches)
    squares = np.array([np.mean(influence(it) ** 2) for it in errors])
    return frozenset(np.flatnonzero(squares > WORSE * np.median(squares)).tolist())


def denied_by(others: Found, alone: Found) -> frozenset[str] | None:
    """Return the effects of one run that the others lack, if these deny them all.

    What they deny makes their data far less likely, all else fitted again. What they do not deny
    may act in them, too, and only not show.
    """
    own = [e for e in alone.selection.final.model.effects if e.name in alone.names - others.names]
    return frozenset(e.name for e in own) if all(_denies(others, e) for e in own) else None


def _denies(found: Found, effect: Effect) -> bool:
    fit = found.selection.final
    space = Space(fit.space.declared.with_effect(effect), fit.space.kinds)
    with_it = fit_prediction(space, fit.stretches, fit.u, fit.gains)
    return with_it.deviance(fit.sigma) - fit.deviance(fit.sigma) > SUSPICIOUS
