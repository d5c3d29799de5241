"""Pauses of a recording: nothing was heard, so how the robot came out of them is not known."""

from collections.abc import Iterable, Mapping

from diffbot_sim.bags.series import Ordered, Stamps, silences


def pauses(usable: Mapping[str, Ordered]) -> list[Stamps]:
    """Return the stamps of the odometry around each time in which all topics were silent.

    usable: by its role, what each topic held.
    """
    odom, *forces = (usable[role] for role in ('odom', 'left_force', 'right_force'))
    return [gap for gap in silences(odom) if all(is_within(gap, silences(f)) for f in forces)]


def is_within(gap: Stamps, others: Iterable[Stamps]) -> bool:
    """Say whether most of a gap is one of others, too: topics fall silent at their own ticks."""
    begin, end = gap
    return any(2 * (min(end, until) - max(begin, since)) > end - begin for since, until in others)
