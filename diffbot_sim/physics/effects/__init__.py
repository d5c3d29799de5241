"""The library of effects: one file each, discovered, never listed."""

from collections import Counter
from functools import cache
from importlib import import_module
from importlib.metadata import entry_points
from pkgutil import iter_modules

from diffbot_sim.errors import ConfigError
from diffbot_sim.physics.effects.effect import Effect, Excitation

ENTRY_POINT_GROUP = 'diffbot_sim.effects'

__all__ = ['Effect', 'Excitation', 'library', 'sought_effects']


@cache
def library() -> dict[str, type[Effect]]:
    """Return every known effect by name, in order of evaluation: stage, then name.

    Reads the files of this folder and the entry points of other installed packages. Raises
    ConfigError where two have one name.
    """
    found: set[type[Effect]] = {item.load() for item in entry_points(group=ENTRY_POINT_GROUP)}
    for module in iter_modules(__path__, __name__ + '.'):
        found.update(
            kind
            for kind in vars(import_module(module.name)).values()
            if isinstance(kind, type) and issubclass(kind, Effect) and kind is not Effect
        )
    names = Counter(kind.name for kind in found)
    if twice := sorted(name for name, times in names.items() if times > 1):
        raise ConfigError(f'effects of the same name: {", ".join(twice)}. Rename one of each.')
    return {kind.name: kind for kind in sorted(found, key=lambda kind: (kind.stage, kind.name))}


def sought_effects() -> dict[str, type[Effect]]:
    """Return the effects that identification may name, in the same order."""
    return {name: kind for name, kind in library().items() if kind.is_sought}
