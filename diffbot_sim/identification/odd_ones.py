"""Runs of another condition than the others: which these are, and what they have of their own."""

from diffbot_sim.identification.conclusions.agreement import odd_runs
from diffbot_sim.identification.fitting.coordinates import Space
from diffbot_sim.identification.fitting.fit import fit_prediction
from diffbot_sim.identification.found import Found
from diffbot_sim.identification.suspicion import SUSPICIOUS
from diffbot_sim.physics.effects import Effect


def odd_among(found: Found) -> frozenset[int]:
    """Return which runs disagree with the others, where something is said of them together."""
    # Of two runs nobody can say which is odd.
    if not found.says_something or len(found.recordings.learned) < 3:
        return frozenset()
    return odd_runs(found.selection.final, found.recordings.learned)


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
