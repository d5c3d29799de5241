"""Numbers in messages that nobody can mean."""

from rclpy.node import Node

from diffbot_sim.nodes.timing import QUIET
from diffbot_sim.records import LARGEST


def accepts(node: Node, topic: str, *values: float) -> bool:
    """Say whether the numbers of a message are finite and of this world; warn of others.

    What is beyond any robot overflows in the sums of a loop or of an integrator, and stays there.
    """
    if all(abs(value) <= LARGEST for value in values):
        return True
    text = ', '.join(map(str, values))
    node.get_logger().warning(
        f'{topic}: {text} is not finite, or beyond {LARGEST:g}; ignored',
        throttle_duration_sec=QUIET,
    )
    return False
