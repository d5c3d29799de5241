"""Which topics of a bag are replayed, and where to: by default the wheel commands."""

from collections.abc import Iterable
from pathlib import Path

from diffbot_sim.errors import BagError

# What a bag tells of the commands: as the driver took them or, failing that, as they were sent.
TAKEN = ('/left_wheel/force', '/right_wheel/force')
SENT = ('/left_wheel/force_cmd', '/right_wheel/force_cmd')


def commands(there: Iterable[str], bag: Path) -> dict[str, str]:
    """Return where to publish the recorded wheel commands, by recorded topic; raises BagError."""
    taken = [topic for topic in there if topic.endswith(TAKEN)]
    if taken:
        return {topic: topic.strip('/') + '_cmd' for topic in taken}
    sent = [topic for topic in there if topic.endswith(SENT)]
    return chosen(sent or [name.strip('/') for name in TAKEN], there, bag)


def chosen(names: Iterable[str], there: Iterable[str], bag: Path) -> dict[str, str]:
    """Return where to publish the topics that were asked for; raises BagError."""
    targets = {f'/{name.strip("/")}': name.strip('/') for name in names}
    if missing := [topic for topic in targets if topic not in there]:
        listed = ', '.join(sorted(there)) or 'no messages'
        raise BagError(f'{bag}: no messages on {", ".join(missing)}. The bag holds {listed}.')
    return targets
