"""Candidates: every effect is tried, and fitted jointly with the nominal parameters."""

from diffbot_sim.identification.coordinates import Space
from diffbot_sim.identification.fitting import Fit, fit_prediction, fit_with_noise_held
from diffbot_sim.identification.screening import Score, Screen
from diffbot_sim.physics.effects import Effect

# Evaluations after which one of several starts is chosen.
SHORT = 4


def extend(screen: Screen, kind: type[Effect], score: Score) -> Fit:
    """Fit a structure with one effect more: first with the noise model held, then with all."""
    base = screen.fit
    space = Space(base.space.declared, (*base.space.kinds, kind))
    starts = list(score.starts)
    if len(starts) > 1:  # local minima: follow several for a while
        tried = [fit_with_noise_held(space, base.stretches, s, base.gains, SHORT) for s in starts]
        starts = [min(tried, key=lambda fit: fit.deviance(base.sigma)).u]
    near = fit_with_noise_held(space, base.stretches, starts[0], base.gains)
    return fit_prediction(space, base.stretches, near.u, near.gains, evaluations=8, rounds=2)


def reduce(fit: Fit, name: str) -> Fit:
    """Fit the structure that lacks one of the effects."""
    kinds = tuple(kind for kind in fit.space.kinds if kind.name != name)
    space = Space(fit.space.declared, kinds)
    kept = [
        index
        for index, coordinate in enumerate(fit.space.coordinates)
        if not coordinate.name.startswith(name + '.')
    ]
    return fit_prediction(space, fit.stretches, fit.u[kept], fit.gains, evaluations=10, rounds=2)
