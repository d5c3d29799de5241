"""Candidates: every effect is tried, and fitted jointly with the nominal parameters."""

from dataclasses import replace

import numpy as np

from diffbot_sim.identification.fitting.coordinates import Space
from diffbot_sim.identification.fitting.fit import (
    FIRST_GAINS,
    Fit,
    fit_prediction,
    fit_with_noise_held,
    innovations,
)
from diffbot_sim.identification.recordings.recordings import Recordings
from diffbot_sim.identification.recordings.start import restarted
from diffbot_sim.identification.selection.screening import Screen
from diffbot_sim.identification.statistics.parallel import side_by_side
from diffbot_sim.identification.statistics.robust import scale_of
from diffbot_sim.physics.effects import Effect
from diffbot_sim.records import Array

# Evaluations after which a start, or an effect, is compared with others.
SHORT = 4


def approach(screen: Screen, kind: type[Effect]) -> Fit:
    """Fit a structure with one effect more for a short while, the noise model held.

    Each start has a local minimum of its own; the best is returned.
    """
    base = screen.fit
    space = Space(base.space.declared, (*base.space.kinds, kind))
    tried = [
        fit_with_noise_held(space, base.stretches, start, base.gains, SHORT, rounds=1)
        for start in screen.starts(kind)
    ]
    return min(tried, key=lambda fit: fit.deviance(base.sigma))


def complete(near: Fit) -> Fit:
    """Fit to the end what was approached, from two noise models; return the better fit.

    The one of the fit that lacks the effect may follow so much of what is missing that parameters
    leave for a hollow far away; one that begins anew knows nothing of the floor yet.
    """
    known, anew = side_by_side(lambda fit: fit(near), (_completed, _completed_anew))
    return min((known, anew), key=lambda end: end.deviance(known.sigma))


def _completed(near: Fit) -> Fit:
    held = fit_with_noise_held(near.space, near.stretches, near.u, near.gains)
    return fit_prediction(near.space, near.stretches, held.u, held.gains)


def _completed_anew(near: Fit) -> Fit:
    return fit_prediction(near.space, near.stretches, near.u, FIRST_GAINS)


def begun_anew(fit: Fit) -> Fit:
    """Fit again from the first states that this model finds best: a poorer one misjudged them."""
    stretches = restarted(fit.model, fit.stretches)
    return fit_prediction(fit.space, stretches, fit.u, fit.gains)


def on_recordings(fit: Fit, recordings: Recordings) -> Fit:
    """Return a structure as it was fitted, on other recordings."""
    fitted, _ = recordings.divided
    return replace(fit, stretches=restarted(fit.model, fitted))


def fit_without(fit: Fit, *names: str) -> Fit:
    """Fit the structure that lacks one of the effects, or several."""
    return refitted(fit.less(*names))


def refitted(fit: Fit) -> Fit:
    """Fit a structure again, which may have changed since, or what it is fitted to.

    From the noise model that errs less now: one that trusts a model with an effect may never catch
    up with what the rest cannot follow, and one for moments overshoots where it hears means.
    """

    def scale(gains: Array) -> float:
        errors = innovations(fit.stretches, fit.space.model(fit.u), gains)
        return float(np.prod(scale_of(errors)))

    gains = min((fit.gains, FIRST_GAINS), key=scale)
    return fit_prediction(fit.space, fit.stretches, fit.u, gains)
