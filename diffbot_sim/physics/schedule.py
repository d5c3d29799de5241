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


def scheduled(model: Model, commands: Commands, start: float) -> Commands:
    """Return the commands of a run as they arrive, and once more at each moment of abrupt change.

    start: when the run begins [s]. Steps are cut at commands, so nothing else need know of the
    moments. A command from before the start counts as having acted for long.
    """
    delay, moments = delay_of(model), moments_of(model)
    if delay == 0.0 and not moments:
        return commands
    commands = _from(start, commands)
    time = np.concatenate([commands.time[:1], commands.time[1:] + delay])
    inside = np.array([m for m in moments if m > time[0]])
    at = np.searchsorted(time, inside, side='right')
    kept = np.sort(np.append(np.arange(len(time)), at - 1))
    return replace(commands.rows(kept), time=np.insert(time, at, inside))


def _from(start: float, commands: Commands) -> Commands:
    """Return commands that say, too, that there is no force before the first of them."""
    if len(commands.time) > 0 and commands.time[0] <= start:
        return commands
    nothing = np.zeros((1, 2))
    unsure = commands.unsure
    return Commands(
        np.append(start, commands.time),
        np.concatenate([nothing, commands.force]),
        None if unsure is None else np.concatenate([nothing, unsure]),
    )
