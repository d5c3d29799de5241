"""Model to nested parameters and back; every key comes from the fields of a dataclass."""

from collections.abc import Iterator, Mapping
from difflib import get_close_matches
from typing import Any

from diffbot_sim.config.parts import checked, part_of, plain
from diffbot_sim.errors import ConfigError
from diffbot_sim.parameters import Spec, specs, suggestion
from diffbot_sim.physics.effects import Effect, library
from diffbot_sim.physics.friction import Friction
from diffbot_sim.physics.model import Model
from diffbot_sim.physics.robot import Robot

SECTIONS = ['robot', 'friction', 'effects']
# The parts with numbers of their own; a text such as `model` may belong to anybody.
PARTS: Mapping[str, tuple[Spec, ...]] = {
    part: tuple(spec for spec in specs(kind) if not spec.choices)
    for part, kind in (('robot', Robot), ('friction', Friction))
}


def model_to_mapping(model: Model) -> dict[str, Any]:
    """Return the sections robot, friction and, where there are any, effects."""
    mapping: dict[str, Any] = {'robot': plain(model.robot), 'friction': plain(model.friction)}
    if model.effects:
        mapping['effects'] = {effect.name: plain(effect) for effect in model.effects}
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
    faults.extend(_misplaced(mapping))
    robot = part_of(Robot, mapping.get('robot'), 'robot', faults)
    friction = part_of(Friction, mapping.get('friction'), 'friction', faults)
    effects = _effects(mapping.get('effects'), faults)
    if faults:
        raise ConfigError(f'{where}: ' + '; '.join(faults))
    return Model(robot, friction, effects)


def _misplaced(mapping: Mapping[str, Any]) -> Iterator[str]:
    """Tell where numbers and effects stand that belong into a section, and are not there."""
    places = {name: f'effects.{name}' for name in library()}
    for part, numbers in PARTS.items():
        given = mapping.get(part)
        known = given if isinstance(given, Mapping) else ()
        places |= {spec.name: f'{part}.{spec.name}' for spec in numbers if spec.name not in known}
    for key, value in mapping.items():
        if key in SECTIONS:
            continue
        below = {name: f'{key}.{name}' for name in value} if isinstance(value, Mapping) else {}
        for name, told in {**below, key: key}.items():
            if name in places:
                yield f'{told}: no place for it. Write {places[name]}'


def _effects(section: Any, faults: list[str]) -> tuple[Effect, ...]:
    known = library()
    found: list[Effect] = []
    for name, values in checked(section, 'effects', known, faults).items():
        if name in known:
            found.append(part_of(known[name], values, f'effects.{name}', faults))
        else:
            faults.append(f'effects.{name}: unknown effect. {suggestion(name, list(known))}')
    return tuple(found)
