"""A drive that shows friction and what a model may lack: steps, arcs, turns and stops."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

# Shares of the kinds of segment: straight, turning on the spot, arc, stop.
KINDS = {'straight': 0.35, 'spin': 0.2, 'arc': 0.33, 'stop': 0.12}
SHORTEST, LONGEST = 0.8, 2.5
# Speeds are drawn from this share of the fastest up to the fastest.
SLOWEST_SHARE = 0.15


@dataclass(frozen=True)
class Segment:
    """A twist that is held until a time: v [m/s], omega [rad/s], until [s] from the start."""

    until: float
    v: float
    omega: float


def excitation(
    seed: int, duration: float, fastest: float, fastest_turn: float
) -> tuple[Segment, ...]:
    """Return random segments for a duration [s]; the same seed gives the same drive.

    fastest [m/s] and fastest_turn [rad/s] bound the twist, forward and backward. The drive begins
    with a second at rest, for the recorder.
    """
    return tuple(_segments(np.random.default_rng(seed), duration, fastest, fastest_turn))


def twist_at(segments: tuple[Segment, ...], time: float) -> tuple[float, float]:
    """Return v and ω at a time [s]; rest when the drive is over."""
    for segment in segments:
        if time < segment.until:
            return segment.v, segment.omega
    return 0.0, 0.0


def _segments(
    random: np.random.Generator, duration: float, fastest: float, fastest_turn: float
) -> Iterator[Segment]:
    until = 1.0
    yield Segment(until, 0.0, 0.0)
    while until < duration:
        until = min(until + random.uniform(SHORTEST, LONGEST), duration)
        kind = random.choice(list(KINDS), p=list(KINDS.values()))
        v = random.choice([-1, 1]) * fastest * random.uniform(SLOWEST_SHARE, 1.0)
        omega = random.choice([-1, 1]) * fastest_turn * random.uniform(SLOWEST_SHARE, 1.0)
        drives, turns = kind in ('straight', 'arc'), kind in ('spin', 'arc')
        yield Segment(until, v if drives else 0.0, omega if turns else 0.0)
