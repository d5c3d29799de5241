"""Model to nested parameters and back; every key comes from the fields of a dataclass."""

from collections.abc import Mapping
from dataclasses import asdict
from difflib import get_close_matches
from typing import Any, TypeVar

from diffbot_sim.errors import ConfigError
from diffbot_sim.parameters import Spec, specs, suggestion
from diffbot_sim.physics.effects import Effect, library
from diffbot_sim.physics.friction import Friction
from diffbot_sim.physics.model import Model
from diffbot_sim.physics.robot import Robot

SECTIONS = ['robot', 'friction', 'effects']

Part = TypeVar('Part')


def model_to_mapping(model: Model) -> dict[str, Any]:
    """Return the sections robot, friction and, where there are any, effects."""
    mapping: dict[str, Any] = {'robot': _plain(model.robot), 'friction': _plain(model.friction)}
    if model.effects:
        mapping['effects'] = {effect.name: _plain(effect) for effect in model.effects}
    return mapping


def model_from_mapping(mapping: Mapping[str, Any], where: str) -> Model:
    """Build a model from its sections; keys of other names belong to the nodes.

    Raises ConfigError, which starts with `where` and tells every fault at once.
    """
    faults = [
        f'{key}: unknown section. {suggestion(key, SECTIONS)}'
        for key in mapping
        if key not in SECTIONS and get_close_matches(key, SECTIONS, cutoff=0.8)
    ]
    robot = _part(Robot, mapping.get('robot'), 'robot', faults)
    friction = _part(Friction, mapping.get('friction'), 'friction', faults)
    effects = _effects(mapping.get('effects'), faults)
    if faults:
        raise ConfigError(f'{where}: ' + '; '.join(faults))
    return Model(robot, friction, effects)


def part_from_mapping(mapping: Mapping[str, Any], name: str, kind: type[Part], where: str) -> Part:
    """Build one section's dataclass; raises ConfigError, which starts with `where`."""
    faults: list[str] = []
    part = _part(kind, mapping.get(name), name, faults)
    if faults:
        raise ConfigError(f'{where}: ' + '; '.join(faults))
    return part


def _plain(part: Robot | Friction | Effect) -> dict[str, Any]:
    # A float stays a float (10.0, not 10): ROS takes no integer for a double.
    return {
        key: value if isinstance(value, str) else float(value)
        for key, value in asdict(part).items()
    }


def _effects(section: Any, faults: list[str]) -> tuple[Effect, ...]:
    known = library()
    found: list[Effect] = []
    for name, values in _checked(section, 'effects', known, faults).items():
        if name in known:
            found.append(_part(known[name], values, f'effects.{name}', faults))
        else:
            faults.append(f'effects.{name}: unknown effect. {suggestion(name, list(known))}')
    return tuple(found)


def _part(kind: type[Part], section: Any, where: str, faults: list[str]) -> Part:
    """Build one dataclass from its section; add what is wrong to faults."""
    known = {spec.name: spec for spec in specs(kind)}
    values = _checked(section, where, known, faults)
    wrong = [text for name, value in values.items() if (text := _fault(name, value, where, known))]
    if not wrong:
        try:
            return kind(**{name: _converted(value) for name, value in values.items()})
        except ConfigError as error:
            wrong = [str(error)]
    faults.extend(wrong)
    return kind()


def _fault(name: str, value: object, where: str, known: Mapping[str, Spec]) -> str | None:
    if name not in known:
        return f'{where}.{name}: unknown parameter. {suggestion(name, list(known))}'
    fault = known[name].fault(value)
    return f'{where}.{name}: {fault}' if fault else None


def _converted(value: Any) -> Any:
    return value if isinstance(value, str) else float(value)


def _checked(
    section: Any, where: str, known: Mapping[str, object], faults: list[str]
) -> Mapping[str, Any]:
    """Return a section as a mapping; one that is there but empty is like one that is absent."""
    if isinstance(section, Mapping):
        return section
    if section is not None:
        faults.append(f'{where}: {section!r} is no mapping. Its keys: {", ".join(known)}.')
    return {}
