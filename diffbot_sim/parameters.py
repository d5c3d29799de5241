"""Parameter fields: one declaration for YAML keys, ROS parameters, fit bounds, report rows."""

from dataclasses import MISSING, dataclass, field, fields
from difflib import get_close_matches
from functools import cache
from math import inf, isfinite
from typing import Any


@dataclass(frozen=True)
class Spec:
    """What is known of one parameter.

    low and high bound the value, both allowed; choices lists the valid texts instead.
    scale is a typical size of a departure from neutral: it starts and scales fits. A limit, whose
    neutral value is endless, is fitted as its reciprocal and scale is a typical size of it.
    """

    name: str
    default: Any
    unit: str
    meaning: str
    low: float = -inf
    high: float = inf
    scale: float = 1.0
    choices: tuple[str, ...] = ()
    reciprocal: bool = False

    @property
    def unit_text(self) -> str:
        """The unit, empty for a pure number."""
        return self.unit.removeprefix('-')

    @property
    def valid(self) -> str:
        """The valid values in words."""
        if self.choices:
            return 'one of ' + ', '.join(self.choices)
        return f'{self.low:g} to {self.high:g} {self.unit_text}'.rstrip()

    def fault(self, value: object) -> str | None:
        """Say what is wrong with a value, or None."""
        if self.choices:
            return None if value in self.choices else self._refuse(value)
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            return self._refuse(value)
        # The comparison comes first: it takes integers of any size, isfinite does not.
        inside = self.low <= value <= self.high and isfinite(value)
        return None if inside else self._refuse(value)

    def _refuse(self, value: object) -> str:
        return f'{value!r} is not valid; {self.name} ({self.meaning}) takes {self.valid}'


def parameter(
    default: Any,
    *,
    unit: str = '',
    meaning: str,
    low: float = -inf,
    high: float = inf,
    scale: float = 1.0,
    choices: tuple[str, ...] = (),
    reciprocal: bool = False,
) -> Any:
    """Declare a dataclass field that is a parameter."""
    facts = {
        'unit': unit,
        'meaning': meaning,
        'low': low,
        'high': high,
        'scale': scale,
        'choices': choices,
        'reciprocal': reciprocal,
    }
    return field(default=default, metadata={'parameter': facts})


def largest(endless: float, *, unit: str, meaning: str, scale: float = 10.0) -> Any:
    """Declare a dataclass field that is a limit, so large that it is none unless given."""
    return parameter(
        endless,
        unit=unit,
        meaning=meaning,
        low=1e-3,
        high=endless,
        scale=scale,
        reciprocal=True,
    )


def specs(kind: Any) -> tuple[Spec, ...]:
    """List the parameters of a dataclass (or of an instance) in the order of its fields."""
    return _declared(kind if isinstance(kind, type) else type(kind))


@cache
def _declared(kind: Any) -> tuple[Spec, ...]:
    return tuple(
        Spec(item.name, None if item.default is MISSING else item.default, **facts)
        for item in fields(kind)
        if (facts := item.metadata.get('parameter')) is not None
    )


def suggestion(word: str, known: list[str]) -> str:
    """Name the known words and the nearest one, for the end of an error message."""
    near = get_close_matches(word, known, n=1)
    guess = f" Did you mean '{near[0]}'?" if near else ''
    return f'Known: {", ".join(known)}.{guess}'
