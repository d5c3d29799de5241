"""Suspicion: an effect that explains too much for chance, and may not enter all the same."""

from math import inf

from diffbot_sim.identification.selection.stepwise import Selection
from diffbot_sim.identification.selection.trials import BEREFT, INCREDIBLE, Trial

# No refused effect lowered the BIC by so much on any of 200 clean robots.
SUSPICIOUS = 50.0
# Beside names a law that is right to a seventh leaves this share of what they explain to others.
SLIGHT = 0.02
# A name that is worth less is believed beside what is left, or refused, if that explains less than
# this share of it.
WORTHIER = 0.5
# Why an effect that explains much may not enter; where it is none of these, it does not last.
REASONS = {
    INCREDIBLE: 'only with values that no robot has',
    BEREFT: 'only by what it shares with another effect',
}


def suspected(selection: Selection, allowed: float) -> Trial | None:
    """Return the refused effect that is most beyond chance, if one is.

    allowed: by how much in BIC anything may seem to explain what was allowed for.
    """
    refused = [t for t in selection.trials if t.refused and not t.evidence.is_contradicted]
    most = max(refused, key=lambda t: t.evidence.delta_bic, default=None)
    named = sum(evidence.delta_bic for evidence in selection.support.values())
    least = SUSPICIOUS + SLIGHT * named + allowed
    # Its worth takes a fit of its own, which is asked for only where it may matter.
    if most is None or most.evidence.delta_bic < least or most.worth < least:
        return None
    return most


def in_words(refused: Trial) -> str:
    """Return what is said of a refused effect before the nearest free form."""
    but = REASONS.get(refused.outcome, 'not all along the runs')
    return f'something that {refused.kind.name} explains in part, though {but}'


def doubted_beside(unnamed: float, selection: Selection) -> str:
    """Return the weakest name where it is not worth enough beside what has none, or none.

    unnamed: worth of an effect that was refused, or of pushes.
    """
    worth, name = weakest(selection)
    return '' if WORTHIER * worth > unnamed else name


def weakest(selection: Selection) -> tuple[float, str]:
    """Return the least worth of a name, and which it is; infinite where there is none."""
    worths = ((evidence.delta_bic, name) for name, evidence in selection.support.items())
    return min(worths, default=(inf, ''))
