"""Parameter files: the ROS 2 form of a model's parameters."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from diffbot_sim.config.document import read_document, write_document
from diffbot_sim.config.mapping import model_from_mapping, model_to_mapping
from diffbot_sim.config.parts import Part, part_of
from diffbot_sim.config.sections import FORM, PARAMETERS, Section, sections_in
from diffbot_sim.errors import ConfigError
from diffbot_sim.physics.model import Model

# What may follow the last slash of a node key whose parameters reach the simulator.
NODES = ('**', '*', 'simulator')


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
    document = read_document(path, option, FORM)
    merged: dict[str, Any] = {}
    try:
        for section in _of_one_robot(document):
            _merge(merged, section.values)
    except ConfigError as error:
        raise ConfigError(f'{path}: {error}') from error
    return merged


def _of_one_robot(document: Mapping[Any, Any]) -> list[Section]:
    """Find the sections for the simulator; those of several robots would be mixed."""
    found = [each for each in sections_in(document) if each.node.rpartition('/')[2] in NODES]
    if not found:
        raise ConfigError(f'no parameters for the simulator. {FORM}')
    named = {section.node for section in found if not section.node.startswith('/**')}
    robots = sorted({node.rpartition('/')[0] or '/' for node in named})
    if len(robots) > 1:
        raise ConfigError(
            f'holds the parameters of several robots: {", ".join(robots)}. Give a file with '
            'those of one.'
        )
    return found


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
