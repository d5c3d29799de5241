"""Where a parameter file of ROS 2 gives a node its values."""

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from diffbot_sim.errors import ConfigError

PARAMETERS = 'ros__parameters'
FORM = f"The file starts with '/**:' and, indented below it, '{PARAMETERS}:'."


class Section(NamedTuple):
    """What stands below a node, by its full name."""

    node: str
    body: Mapping[Any, Any]

    @property
    def values(self) -> Mapping[Any, Any]:
        """The parameters; raises ConfigError where the node would not read some of them."""
        values = self.body[PARAMETERS]
        if not isinstance(values, Mapping):
            raise ConfigError(f'{PARAMETERS} holds {values!r}, not keys and values.')
        if PARAMETERS in values:
            raise ConfigError(f"'{PARAMETERS}' stands below another one; keep one of them.")
        if beside := [str(key) for key in self.body if key != PARAMETERS]:
            raise ConfigError(f"{beside[0]} stands beside '{PARAMETERS}'. {FORM}")
        return values


def sections_in(document: Mapping[Any, Any], above: str = '') -> Iterator[Section]:
    """Find the section of each node, also below nested namespaces.

    Raises ConfigError where something stands that belongs to no node.
    """
    for key, body in document.items():
        name = f'{above}/{str(key).strip("/")}'
        if not isinstance(body, Mapping):
            raise ConfigError(f"{name} stands outside of '{PARAMETERS}'. {FORM}")
        if PARAMETERS in body:
            yield Section(name, body)
        else:
            yield from sections_in(body, name)
