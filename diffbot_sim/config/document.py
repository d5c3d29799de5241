"""YAML documents: the only module that knows YAML."""

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import yaml

from diffbot_sim.errors import ConfigError
from diffbot_sim.files import write_whole


class _Loader(yaml.SafeLoader):
    """Reads 1e-3 as a number, as ROS does; YAML 1.1 alone wants 1.0e-3. Refuses a key twice."""

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Any, Any]:
        """Return a mapping; the last of two equal keys would win without a word."""
        mapping: dict[Any, Any] = super().construct_mapping(node, deep)
        if len(mapping) < len(node.value):
            keys = [self.construct_object(key, deep=True) for key, _ in node.value]
            index = next(i for i, key in enumerate(keys) if key in keys[:i])
            mark = node.value[index][0].start_mark
            raise yaml.constructor.ConstructorError(
                None, None, f'{keys[index]} stands twice; keep one', mark
            )
        return mapping


_Loader.add_implicit_resolver(
    'tag:yaml.org,2002:float',
    re.compile(r'[-+]?(\d+\.?\d*|\.\d+)[eE][-+]?\d+$'),
    list('-+.0123456789'),
)


def read_document(path: str | Path, option: str, form: str) -> Mapping[Any, Any]:
    """Read a mapping; raises ConfigError, with the option that names the file and its form."""
    try:
        document = yaml.load(Path(path).read_text('utf-8'), _Loader)
    except FileNotFoundError as error:
        raise ConfigError(f'{path}: there is no such file. Give {option} a YAML file.') from error
    except OSError as error:
        raise ConfigError(f'{path}: cannot be read: {error.strerror}.') from error
    except yaml.MarkedYAMLError as error:
        line = error.problem_mark.line + 1 if error.problem_mark else 1
        raise ConfigError(f'{path}: line {line}: {error.problem}.') from error
    except (yaml.YAMLError, ValueError) as error:
        raise ConfigError(f'{path}: not YAML: {str(error).splitlines()[0]}.') from error
    if not isinstance(document, Mapping):
        raise ConfigError(f'{path}: {"empty" if document is None else "not a mapping"}. {form}')
    return document


def write_document(document: Mapping[str, Any], path: str | Path, comment: str) -> None:
    """Write a mapping below a comment; raises ConfigError when the file cannot be written."""
    head = ''.join(f'# {line}'.rstrip() + '\n' for line in comment.splitlines())
    body = yaml.safe_dump(document, sort_keys=False, default_flow_style=None, width=99)
    try:
        write_whole(Path(path), head + body)
    except OSError as error:
        raise ConfigError(f'{path}: cannot be written: {error.strerror}.') from error
