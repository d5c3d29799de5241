"""What of the odometry the forces are known for: what drove it otherwise explains nothing."""

from collections.abc import Iterable
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from diffbot_sim.bags.poses import TWIST
from diffbot_sim.bags.series import LONGEST_SILENCE, Ordered, Stamps, silence, silences
from diffbot_sim.errors import BagError
from diffbot_sim.records import NANOSECONDS
from diffbot_sim.standing import is_moving


class Known(NamedTuple):
    """Odometry that forces are known for, and a line for each force that is known for less."""

    odom: Ordered
    notes: tuple[str, ...] = ()


def known(odom: Ordered, forces: Iterable[Ordered]) -> Known:
    """Return the odometry between where the forces begin and where they end.

    Before they begin none acts as long as the robot rests. What they end with is held where it is
    none, or where they may have been sent when they changed: not all along, or with pauses.
    Raises BagError where no odometry is left.
    """
    left, notes = odom, list[str]()
    for force in forces:
        for bound in (_begun, _ended):
            left, told = bound(left, force)
            notes += told
            if not len(left.stamp):
                raise apart(force.topic, force.stamp, odom.stamp)
    return Known(left, tuple(notes))


def apart(what: str, force: Stamps, odom: Stamps) -> BagError:
    """Return what is to be said of forces and odometry that have no time in common."""
    gap = _seconds(max(force[0], odom[0]) - min(force[-1], odom[-1]))
    if gap < 0.0:
        return BagError(
            f'{what} is known for no time at which the other force is, and the robot moves. '
            'Record both from the beginning to the end.'
        )
    return BagError(
        f'{what} and odometry do not overlap in time, they are {gap:.3g} s apart. Were they '
        'stamped by different clocks? Give every node the same use_sim_time.'
    )


def _begun(odom: Ordered, force: Ordered) -> Known:
    before = odom.stamp < force.stamp[0]
    late = _seconds(force.stamp[0] - odom.stamp[0])
    if late <= LONGEST_SILENCE:
        return Known(odom)
    told = f'{force.topic} begins {late:.1f} s after the odometry'
    if is_moving(odom.values[before, TWIST]):
        return Known(_part(odom, ~before), (f'{told}, which moves: left out until then',))
    return Known(odom, (f'{told}; taken as 0 until then',))


def _ended(odom: Ordered, force: Ordered) -> Known:
    early = _seconds(odom.stamp[-1] - force.stamp[-1])
    if early <= LONGEST_SILENCE:
        return Known(odom)
    told = f'{force.topic} ends {early:.1f} s before the odometry'
    last = float(force.values[-1, 0])
    if last == 0.0 or not _was_sent_all_along(force, odom):
        return Known(odom, (f'{told}; its last force is held',))
    words = f'{told}, with {last:g} N; left out from there on'
    return Known(_part(odom, odom.stamp <= force.stamp[-1]), (words,))


def _was_sent_all_along(force: Ordered, odom: Ordered) -> bool:
    """Say whether a force was sent all along, without a pause, but for the end."""
    left = odom.stamp[-1] - force.stamp[-1]
    return bool(not silences(force) and left > silence(force) and np.ptp(force.stamp) > left)


def _part(odom: Ordered, kept: NDArray[np.bool_]) -> Ordered:
    return replace(odom, stamp=odom.stamp[kept], values=odom.values[kept])


def _seconds(span: np.int64) -> float:
    return float(span) / NANOSECONDS
