"""What lost commands leave unsure: the speed, until as many samples have told it as noise asks.

The gains of a noise model are those of all samples. After a command that was lost, odometry knows
more of the speed than a prediction does: it corrects that as a Kalman filter would, and what it
says of the model counts less.
"""

from typing import NamedTuple

import numpy as np

from diffbot_sim.identification.recordings.acting import added_up
from diffbot_sim.identification.statistics.norms import white_noise
from diffbot_sim.records import Array, Commands

# A noise [m/s, rad/s] that is as good as none.
TINY = 1e-9


class Unheard(NamedTuple):
    """How errors of v and ω count after commands that were lost.

    regained, shape (k, 2): the share of each error by which the speed is corrected at once, above
    1 where means tell half of a change; weight, shape (k, 2): what it counts, as it scatters more
    than others.
    """

    regained: Array
    weight: Array

    def taken(self, gains: Array) -> Array:
        """Return the share of each error that is corrected, by gains of v and ω, (2,), as well."""
        return np.asarray(1.0 - (1.0 - gains) * (1.0 - self.regained))


def all_heard(count: int) -> Unheard:
    """Return how errors count where no command was lost: all alike."""
    return Unheard(np.zeros((count, 2)), np.ones((count, 2)))


def unheard(commands: Commands, time: Array, twist: Array, means: tuple[bool, bool]) -> Unheard:
    """Return how the errors count of what was seen of a robot that was commanded."""
    told = all_heard(len(time))
    if commands.unsure is None:
        return told
    noise, variance = np.maximum(white_noise(twist), TINY) ** 2, np.zeros(2)
    seen = np.where(means, 0.5, 1.0)  # of a change of speed in the interval before a sample
    for k, more in enumerate(_variance(commands, commands.unsure, time, twist), start=1):
        scatter = variance + seen**2 * more + noise
        told.regained[k] = (variance + seen * more) / scatter
        told.weight[k] = np.sqrt(noise / scatter)
        variance = variance + more - told.regained[k] ** 2 * scatter
    return told


def _variance(commands: Commands, unsure: Array, time: Array, twist: Array) -> Array:
    """Return the variance that lost commands add to v and ω over each interval, (k - 1, 2)."""
    by_wheels, added = (
        np.diff(added_up(commands.time, held, time), axis=0) for held in (commands.force, unsure)
    )
    on_body = by_wheels @ np.array([[1.0, 1.0], [1.0, -1.0]])
    moved = np.array([_moved(*axis) for axis in zip(on_body.T, twist.T, strict=True)])
    return np.asarray(added.sum(axis=1, keepdims=True) * moved**2)


def _moved(impulse: Array, rate: Array) -> float:
    """Return by how much an impulse changes a rate, as the motion tells it beside friction."""
    known = np.column_stack([impulse, rate[:-1], np.sign(rate[:-1]), np.ones(len(impulse))])
    return float(np.linalg.lstsq(known, np.diff(rate))[0][0])
