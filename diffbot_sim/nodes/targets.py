"""Which topics of a bag are replayed, and where to: by default the wheel commands."""

from collections.abc import Collection, Iterable
from pathlib import Path

from diffbot_sim.bags.topics import absolute, wheel_forces
from diffbot_sim.errors import BagError

COMMAND = '_cmd'


def commands(there: Collection[str], bag: Path) -> dict[str, str]:
    """Return where to publish the recorded wheel commands, by recorded topic; raises BagError.

    They are those that the driver took or, failing that, those that were sent.
    """
    forces = wheel_forces(there)
    if not forces:
        raise BagError(f'{bag}: no forces of wheels. {_inventory(there)}')
    return {topic: topic.strip('/').removesuffix(COMMAND) + COMMAND for topic in forces}


def chosen(names: Iterable[str], there: Collection[str], bag: Path) -> dict[str, str]:
    """Return where to publish the topics that were asked for; raises BagError."""
    targets = {absolute(name): name.strip('/') for name in names}
    if missing := [topic for topic in targets if topic not in there]:
        raise BagError(f'{bag}: no messages on {", ".join(missing)}. {_inventory(there)}')
    return targets


def _inventory(there: Collection[str]) -> str:
    return f'The bag holds {", ".join(sorted(there)) or "no messages"}.'
