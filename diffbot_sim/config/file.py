"""Parameter files: the only module that knows YAML."""

import re
from collections.abc import Iterator, Mapping
from os import replace
from pathlib import Path
from typing import Any

import yaml

from diffbot_sim.config.mapping import (
    Part,
    model_from_mapping,
    model_to_mapping,
    part_from_mapping,
)
from diffbot_sim.errors import ConfigError
from diffbot_sim.physics.model import Model

# What may follow the last slash of a node key whose parameters reach the simulator.
NODES = ('**', '*', 'simulator')
PARAMETERS = 'ros__parameters'
FORM = f"The file starts with '/**:' and, indented below it, '{PARAMETERS}:'."


class _Loader(yaml.SafeLoader):
    """Reads 1e-3 as a number, as ROS does; YAML 1.1 alone wants 1.0e-3."""


_Loader.add_implicit_resolver(
    'tag:yaml.org,2002:float',
    re.compile(r'[-+]?(\d+\.?\d*|\.\d+)[eE][-+]?\d+$'),
    list('-+.0123456789'),
)


def load_model(path: str | Path) -> Model:
    """Read a parameter file; raises ConfigError that tells every fault at once."""
    return model_from_mapping(_merged(path), str(path))


def load_section(path: str | Path, name: str, kind: type[Part]) -> Part:
    """Read one section of a parameter file, such as `pi`, as the dataclass of its fields.

    What is absent keeps its default. Raises ConfigError that tells every fault at once.
    """
    return part_from_mapping(_merged(path), name, kind, str(path))


def save_model(model: Model, path: str | Path, comment: str = '') -> None:
    """Write a parameter file from which load_model returns an equal model.

    Raises ConfigError when the file cannot be written.
    """
    head = ''.join(f'# {line}'.rstrip() + '\n' for line in comment.splitlines())
    document = {'/**': {PARAMETERS: model_to_mapping(model)}}
    body = yaml.safe_dump(document, sort_keys=False, default_flow_style=None, width=99)
    target = Path(path)
    unfinished = target.with_name(target.name + '.part')
    try:
        unfinished.write_text(head + body, 'utf-8')
        replace(unfinished, target)
    except OSError as error:
        raise ConfigError(f'{path}: cannot be written: {error.strerror}.') from error


def _merged(path: str | Path) -> dict[str, Any]:
    """Lay all sections for the simulator over each other."""
    merged: dict[str, Any] = {}
    found = False
    for section in _sections(_parsed(path)):
        if not isinstance(section, Mapping):
            raise ConfigError(f'{path}: {PARAMETERS} holds {section!r}, not keys and values.')
        _merge(merged, section)
        found = True
    if not found:
        raise ConfigError(f'{path}: no parameters for the simulator. {FORM}')
    return merged


def _parsed(path: str | Path) -> Mapping[Any, Any]:
    try:
        document = yaml.load(Path(path).read_text('utf-8'), _Loader)
    except FileNotFoundError as error:
        raise ConfigError(f'{path}: there is no such file. Give --params a YAML file.') from error
    except OSError as error:
        raise ConfigError(f'{path}: cannot be read: {error.strerror}.') from error
    except yaml.MarkedYAMLError as error:
        line = error.problem_mark.line + 1 if error.problem_mark else 1
        raise ConfigError(f'{path}: line {line}: {error.problem}.') from error
    except (yaml.YAMLError, ValueError) as error:
        raise ConfigError(f'{path}: not YAML: {str(error).splitlines()[0]}.') from error
    if not isinstance(document, Mapping):
        raise ConfigError(f'{path}: {"empty" if document is None else "not a mapping"}. {FORM}')
    return document


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
