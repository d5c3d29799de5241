"""What the commands become before any kernel sees them: late, and cut where effects change."""

from dataclasses import replace

import numpy as np

from diffbot_sim.physics.model import Model
from diffbot_sim.records import Commands


def delay_of(model: Model) -> float:
    """Return by how much commands come late [s]."""
    return float(sum(effect.delay for effect in model.effects))


def moments_of(model: Model) -> tuple[float, ...]:
    """Return when effects change abruptly [s], in order."""
    return tuple(sorted(moment for effect in model.effects for moment in effect.moments))


def scheduled(model: Model, commands: Commands) -> Commands:
    """Return the commands as they arrive, and once more at each moment of abrupt change.

    Steps are cut at commands, so nothing else need know of the moments. The first command counts
    as having acted for long, however late it comes.
    """
    delay, moments = delay_of(model), moments_of(model)
    if len(commands.time) == 0 or (delay == 0.0 and not moments):
        return commands
    time = np.concatenate([commands.time[:1], commands.time[1:] + delay])
    inside = np.array([m for m in moments if m > time[0]])
    at = np.searchsorted(time, inside, side='right')
    kept = np.sort(np.append(np.arange(len(time)), at - 1))
    return replace(commands.rows(kept), time=np.insert(time, at, inside))
