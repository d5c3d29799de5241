"""In which waves a force that repeats itself is looked for."""

from collections.abc import Callable, Sequence
from functools import partial

from diffbot_sim.identification.fitting.periodicity import TEETH, rates, repeats, rubbing_orders
from diffbot_sim.identification.fitting.views import View
from diffbot_sim.identification.free_forms.forms import Waves

# Rates that differ by a line width, among which the strongest were chosen; a generous count.
LOOKED_AT = 1000


def alone(rates: Callable[[Sequence[View]], Sequence[float]]) -> Waves:
    """Return what gives each rate as a wave of its own."""
    return lambda seen: [(rate,) for rate in rates(seen)]


def rhythms(seen: Sequence[View]) -> list[tuple[float, ...]]:
    """Return single waves, and short pushes: waves with their harmonics, and their mean."""
    return [*alone(rates)(seen), *((*_harmonics(rate), 0.0) for rate in repeats(seen))]


def rubbing(seen: Sequence[View]) -> list[tuple[float, ...]]:
    """Return single waves of a wheel's angle, and tight spots: waves with their harmonics."""
    waves = alone(partial(rubbing_orders, teeth=1))(seen)
    return [*waves, *map(_harmonics, rubbing_orders(seen, TEETH))]


def _harmonics(rate: float) -> tuple[float, ...]:
    return tuple(rate * h for h in range(1, TEETH + 1))
