"""Numbers in messages that nobody can mean."""

from collections.abc import Iterable

from rclpy.node import Node

from diffbot_sim.nodes.timing import QUIET
from diffbot_sim.records import LARGEST


def are_sane(values: Iterable[float]) -> bool:
    """Say whether numbers are finite and of this world."""
    return all(abs(value) <= LARGEST for value in values)


def accepts(node: Node, topic: str, *values: float) -> bool:
    """Say whether the numbers of a message are finite and of this world; warn of others.

    What is beyond any robot overflows in the sums of a loop or of an integrator, and stays there.
    """
    if are_sane(values):
        return True
    text = ', '.join(map(str, values))
    node.get_logger().warning(
        f'{topic}: {text} is not finite, or beyond {LARGEST:g}; ignored',
        throttle_duration_sec=QUIET,
    )
    return False
