"""A limit of each wheel's force without a law: a table over how fast the wheel turns with it."""

from dataclasses import dataclass
from typing import Any

from diffbot_sim.parameters import largest, parameter
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.effects.effect import Effect
from diffbot_sim.physics.effects.power_limit import bend_at
from diffbot_sim.physics.effects.voltage_limit import BEND
from diffbot_sim.physics.stages import Stage, Traction, nearly_within

# As good as none [N].
UNLIMITED = 1e9
# Where the points lie: shares of the speed at the end, below zero against the force.
PLACES = (-1.0, -0.5, 0.0, 0.25, 0.5, 0.75, 1.0)


@compiled
def between(low: float, high: float, share: float) -> float:
    """Return the limit some way between two points: its reciprocal changes in a line."""
    return 1.0 / ((1.0 - share) / low + share / high)


@compiled
def limit_at(share, points):  # type: ignore[no-untyped-def]
    """Return the limit at a share of the speed at the end."""
    if share <= PLACES[0]:
        return points[0]
    for k in range(1, len(PLACES)):
        if share < PLACES[k]:
            part = (share - PLACES[k - 1]) / (PLACES[k] - PLACES[k - 1])
            return between(points[k - 1], points[k], part)
    return points[len(PLACES) - 1]


@compiled
def held(force, speed, bend, end, points):  # type: ignore[no-untyped-def]
    """Return a force [N] that is hardly more than the table allows."""
    along = speed if force > 0.0 else -speed
    return nearly_within(force, limit_at(along / end, points), bend)


@compiled
def limited(at, traction, end, *points):  # type: ignore[no-untyped-def]
    """Limit the force of each wheel by the table, its corner as near as that of a voltage."""
    return Traction(
        held(traction.right, at.speed_right, BEND, end, points),
        held(traction.left, at.speed_left, BEND, end, points),
    )


@compiled
def limited_widely(at, traction, end, *points):  # type: ignore[no-untyped-def]
    """Limit the force of each wheel by the table, its corner as wide as that of a power."""
    return Traction(
        held(traction.right, at.speed_right, bend_at(at.speed_right), end, points),
        held(traction.left, at.speed_left, bend_at(at.speed_left), end, points),
    )


def point(share: float) -> Any:
    """Declare a point of the table [N]."""
    meaning = f'largest force of a wheel that turns at {share:.0%} of speed, with it'
    return largest(UNLIMITED, unit='N', meaning=meaning)


@dataclass(frozen=True)
class EmpiricalLimit(Effect):
    """Force on each wheel of at most what a table over its speed allows, rounded there.

    Between points the limit's reciprocal changes in a line; beyond the ends the limit stays. A
    sharp turn of the table costs the integrator its order as a wheel passes it. Identification
    holds it against the laws of limits: what it outdoes is another law.
    """

    name = 'empirical_limit'
    meaning = 'largest force of each wheel by a table over its speed; no law, it only describes'
    source = 'learned from recorded drives, against the laws of limits'
    stage = Stage.ACTUATOR
    kernel = limited
    is_sought = False
    guesses = ((1.0, 9.0, 9.0, 9.0, 8.0, 7.5, 7.0, 6.5),)
    shape = ('speed',)
    excitation = 'the strongest commands, from rest until it is fast, and against its motion'

    speed: float = parameter(
        1.0, unit='m/s', low=1e-3, high=1e3, meaning='speed of a wheel at the end of the table'
    )
    braking_2: float = point(-1.0)
    braking_1: float = point(-0.5)
    at_rest: float = point(0.0)
    driving_1: float = point(0.25)
    driving_2: float = point(0.5)
    driving_3: float = point(0.75)
    driving_4: float = point(1.0)
