"""Fits shaken out of local minima: whether a wheel breaks away is a jump that errors hang on."""

from collections.abc import Iterator

from diffbot_sim.identification.fitting import FIRST_GAINS, Fit, fit_prediction
from diffbot_sim.records import Array

# What decides whether a wheel breaks away or sticks, and how far it is moved, in its coordinate.
SHAKEN, KICK = ('mu_coulomb', 'mu_static'), 0.15
# A fall of the deviance below this is none; so many times is a lower minimum looked for.
LOWER, ROUNDS = 1.0, 4


def shaken(fit: Fit) -> Fit:
    """Fit again from points beside this one while that leads lower; return the lowest."""
    for _ in range(ROUNDS):
        ends = (fit_prediction(fit.space, fit.stretches, *start) for start in _beside(fit))
        best = min(ends, key=lambda end: end.deviance(fit.sigma))
        if fit.deviance(fit.sigma) - best.deviance(fit.sigma) < LOWER:
            return fit
        fit = best
    return fit


def _beside(fit: Fit) -> Iterator[tuple[Array, Array]]:
    """Yield points and noise models: the first one of all, and other friction at rest."""
    yield fit.u, FIRST_GAINS
    names = [coordinate.name for coordinate in fit.space.coordinates]
    for index in (names.index(name) for name in SHAKEN if name in names):
        for kick in (KICK, -KICK):
            beside = fit.u.copy()
            beside[index] += kick
            yield beside, fit.gains
