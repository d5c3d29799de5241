"""One dataclass of parameters from its section of a file, and back."""

from collections.abc import Mapping
from typing import Any, TypeVar

from diffbot_sim.errors import ConfigError
from diffbot_sim.parameters import Spec, specs, suggestion

Part = TypeVar('Part')


def plain(part: Any) -> dict[str, Any]:
    """Return the parameters of a dataclass as YAML holds them."""
    # A float stays a float (10.0, not 10): ROS takes no integer for a double.
    return {spec.name: _converted(getattr(part, spec.name)) for spec in specs(part)}


def part_of(kind: type[Part], section: Any, where: str, faults: list[str]) -> Part:
    """Build one dataclass from its section; add what is wrong to faults.

    where: the keys that lead to the section, as 'effects.slope'; '' for the file itself.
    """
    known = {spec.name: spec for spec in specs(kind)}
    values = checked(section, where, known, faults)
    wrong = [text for name, value in values.items() if (text := _fault(name, value, where, known))]
    if not wrong:
        try:
            return kind(**{name: _converted(value) for name, value in values.items()})
        except ConfigError as error:
            wrong = [str(error)]
    faults.extend(wrong)
    return kind()


def checked(
    section: Any, where: str, known: Mapping[str, object], faults: list[str]
) -> Mapping[str, Any]:
    """Return a section as a mapping; one that is there but empty is like one that is absent."""
    if isinstance(section, Mapping):
        return section
    if section is not None:
        faults.append(f'{where}: {section!r} is no mapping. Its keys: {", ".join(known)}.')
    return {}


def _fault(name: str, value: object, where: str, known: Mapping[str, Spec]) -> str | None:
    place = f'{where}.{name}' if where else name
    if name not in known:
        return f'{place}: unknown parameter. {suggestion(str(name), list(known))}'
    fault = known[name].fault(value)
    return f'{place}: {fault}' if fault else None


def _converted(value: Any) -> Any:
    return value if isinstance(value, str) else float(value)
