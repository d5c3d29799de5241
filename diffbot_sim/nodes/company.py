"""Who else is on a node's topics: another robot, or a message of another type."""

from typing import Any

from rclpy.node import Node

from diffbot_sim.nodes.timing import steady_clock

LOOK_AGAIN = 2.0  # [s]
SELDOM = 60.0  # [s] between warnings


def watch_for_doubles(node: Node, topic: str) -> None:
    """Warn while another node publishes what this one does, such as a simulator left running."""
    name = node.resolve_topic_name(topic)

    def look() -> None:
        others = node.count_publishers(name) - 1
        if others > 0:
            node.get_logger().warning(
                f'{name}: {others} other publisher{"s" * (others > 1)}; is another simulator '
                'running? Give each robot a namespace of its own',
                throttle_duration_sec=SELDOM,
            )

    node.create_timer(LOOK_AGAIN, look, clock=steady_clock())


def watch_for_type(node: Node, topic: str, wanted: Any, advice: str) -> None:
    """Warn while a topic that this node listens to is published with another type only."""
    name, module = node.resolve_topic_name(topic), wanted.__module__.partition('.')[0]
    kind = f'{module}/msg/{wanted.__name__}'

    def look() -> None:
        kinds = {other.topic_type for other in node.get_publishers_info_by_topic(name)}
        if kinds and kind not in kinds:
            node.get_logger().warning(
                f'{name} comes as {", ".join(sorted(kinds))}, this node listens for {kind}: '
                f'{advice}',
                throttle_duration_sec=SELDOM,
            )

    node.create_timer(LOOK_AGAIN, look, clock=steady_clock())
