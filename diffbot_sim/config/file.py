"""Parameter files: the ROS 2 form of a model's parameters."""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from diffbot_sim.config.document import read_document, write_document
from diffbot_sim.config.mapping import model_from_mapping, model_to_mapping
from diffbot_sim.config.parts import Part, part_of
from diffbot_sim.errors import ConfigError
from diffbot_sim.physics.model import Model

# What may follow the last slash of a node key whose parameters reach the simulator.
NODES = ('**', '*', 'simulator')
PARAMETERS = 'ros__parameters'
FORM = f"The file starts with '/**:' and, indented below it, '{PARAMETERS}:'."


def load_model(path: str | Path, option: str = '--params') -> Model:
    """Read a parameter file; raises ConfigError that tells every fault at once.

    option: what the user named the file with, for the errors.
    """
    return model_from_mapping(_merged(path, option), str(path))


def load_section(path: str | Path, name: str, kind: type[Part], option: str = '--params') -> Part:
    """Read one section of a parameter file, such as `pi`, as the dataclass of its fields.

    What is absent keeps its default. Raises ConfigError that tells every fault at once.
    """
    faults: list[str] = []
    part = part_of(kind, _merged(path, option).get(name), name, faults)
    if faults:
        raise ConfigError(f'{path}: ' + '; '.join(faults))
    return part


def left_out(path: str | Path, section: str, keys: Sequence[str]) -> list[str]:
    """Return which keys of a section a parameter file leaves to their defaults."""
    given = _merged(path, '--params').get(section)
    return [key for key in keys if not isinstance(given, Mapping) or key not in given]


def save_model(model: Model, path: str | Path, comment: str = '') -> None:
    """Write a parameter file from which load_model returns an equal model.

    Raises ConfigError when the file cannot be written.
    """
    write_document({'/**': {PARAMETERS: model_to_mapping(model)}}, path, comment)


def _merged(path: str | Path, option: str) -> dict[str, Any]:
    """Lay all sections for the simulator over each other."""
    merged: dict[str, Any] = {}
    found = False
    for section in _sections(read_document(path, option, FORM)):
        if not isinstance(section, Mapping):
            raise ConfigError(f'{path}: {PARAMETERS} holds {section!r}, not keys and values.')
        _merge(merged, section)
        found = True
    if not found:
        raise ConfigError(f'{path}: no parameters for the simulator. {FORM}')
    return merged


def _sections(document: Mapping[Any, Any]) -> Iterator[Any]:
    """Find the parameters that reach the simulator, also below nested namespaces."""
    for key, body in document.items():
        if not isinstance(body, Mapping):
            continue
        if PARAMETERS not in body:
            yield from _sections(body)
        elif str(key).rpartition('/')[2] in NODES:
            yield body[PARAMETERS]


def _merge(base: dict[str, Any], section: Mapping[Any, Any]) -> None:
    """Lay a section over what came before; 'robot.mass: 9.0' is short for nested keys."""
    for key, value in section.items():
        head, _, rest = str(key).partition('.')
        if rest or isinstance(value, Mapping):
            below = base.get(head)
            base[head] = below if isinstance(below, dict) else {}
            _merge(base[head], {rest: value} if rest else value)
        else:
            base[head] = value
