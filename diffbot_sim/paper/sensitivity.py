"""How far each chosen constant may move, alone, before a sentence of the paper fails."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from math import sqrt

from diffbot_sim.errors import ConfigError
from diffbot_sim.paper.catalogue import EXPERIMENTS
from diffbot_sim.paper.constants import Constants

# F_N is no choice of ours for Figs. 8 and 9.
VARIED = {
    'robot': ('mass', 'inertia', 'wheel_separation', 'wheel_radius'),
    'friction': ('mu_static', 'mu_coulomb', 'mu_viscous', 'stribeck'),
    'gains': ('kp', 'ki'),
}
FARTHEST = 100.0  # as a factor; what holds so far is not tried further
PRECISION = 1.005


@dataclass(frozen=True)
class Range:
    """Within low and high all sentences hold; beyond, `fails` names the first that does not.

    fails: at the low and at the high end; empty where FARTHEST was reached.
    """

    name: str
    value: float
    low: float
    high: float
    fails: tuple[str, str]


def sensitivity(constants: Constants) -> Iterator[Range]:
    """Vary each constant alone, up and down; the constants themselves must pass."""
    for section, names in VARIED.items():
        for name in names:
            yield range_of(constants, section, name)


def first_failure(constants: Constants) -> str:
    """Name the first claim that fails by its source and sentence; empty where all hold."""
    for experiment in EXPERIMENTS:
        for claim in experiment.claims(constants, experiment.run(constants)):
            if not claim.holds:
                return f'{claim.source}: {claim.statement}'
    return ''


def range_of(constants: Constants, section: str, name: str) -> Range:
    """Vary one constant alone, up and down."""
    part = getattr(constants, section)
    value = getattr(part, name)

    def failure(factor: float) -> str:
        try:
            moved = replace(part, **{name: factor * value})
        except ConfigError:
            return 'friction.mu_coulomb exceeds friction.mu_static'
        return first_failure(replace(constants, **{section: moved}))

    (low, below), (high, above) = (_reach(failure, way) for way in (0.5, 2.0))
    label = f'{"pi" if section == "gains" else section}.{name}'
    return Range(label, value, low * value, high * value, (below, above))


def _reach(failure: Callable[[float], str], way: float) -> tuple[float, str]:
    """Return the last factor that holds going one way from 1, and what fails beyond it."""
    good, bad, why = 1.0, way, ''
    while not (why := failure(bad)):
        good, bad = bad, bad * way
        if not 1.0 / FARTHEST <= good <= FARTHEST:
            return good, ''
    while not 1.0 / PRECISION < bad / good < PRECISION:
        middle = sqrt(good * bad)
        reason = failure(middle)
        good, bad, why = (good, middle, reason) if reason else (middle, bad, why)
    return good, why
