"""Publish what a bag recorded, at its recorded spacing: by default the wheel commands."""

from argparse import ArgumentTypeError
from collections.abc import Iterable
from math import isfinite
from pathlib import Path
from time import monotonic
from typing import Any

import rclpy
from rclpy.duration import Duration
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node

from diffbot_sim.bags.raw import raw_messages, topics_in
from diffbot_sim.errors import BagError
from diffbot_sim.nodes import conversions
from diffbot_sim.nodes.conversions import NANOSECONDS
from diffbot_sim.nodes.running import parse, parser, run

# What a bag tells of the commands: as the driver took them or, failing that, as they were sent.
TAKEN = ('/left_wheel/force', '/right_wheel/force')
SENT = ('/left_wheel/force_cmd', '/right_wheel/force_cmd')
DEPTH = 100
PATIENCE = 5.0  # [s] to wait for listeners


class Replay(Node):
    """Publishes serialized messages, each topic in the node's namespace."""

    def __init__(self, bag: Path, asked: list[str] | None) -> None:
        super().__init__('replay')
        self._bag = bag
        there = topics_in(bag)
        targets = _chosen(asked, there, bag) if asked else _commands(there, bag)
        self._outlets = {
            topic: self._outlet(there[topic], target) for topic, target in targets.items()
        }

    def play(self, rate: float, loop: bool) -> None:
        """Publish the bag, `rate` times as fast as it was recorded."""
        self._await_listeners()
        self.get_logger().info(f'replaying {", ".join(self._outlets)} of {self._bag}')
        self._play_once(rate)
        while loop:
            self._play_once(rate)
        for outlet in self._outlets.values():
            outlet.wait_for_all_acked(Duration(seconds=1))
        self.get_logger().info('done')

    def _play_once(self, rate: float) -> None:
        begin, first = monotonic(), None
        for message in raw_messages(self._bag, self._outlets):
            first = message.stamp if first is None else first
            self._wait_until(begin + (message.stamp - first) / NANOSECONDS / rate)
            self._outlets[message.topic].publish(message.data)

    def _wait_until(self, moment: float) -> None:
        while (left := moment - monotonic()) > 0.0 and rclpy.ok():
            rclpy.spin_once(self, timeout_sec=left)
        if not rclpy.ok():
            raise ExternalShutdownException

    def _await_listeners(self) -> None:
        """Wait until someone hears each topic: what nobody hears at the start is lost."""
        patience = monotonic() + PATIENCE
        while (deaf := self._unheard()) and monotonic() < patience:
            self._wait_until(monotonic() + 0.05)
        if deaf:
            self.get_logger().warning(f'nobody listens to {", ".join(deaf)}')

    def _unheard(self) -> list[str]:
        outlets = self._outlets.values()
        return [item.topic_name for item in outlets if not item.get_subscription_count()]

    def _outlet(self, kind: str, target: str) -> Any:
        message_type = conversions.message_type(kind)
        if message_type is None:
            raise BagError(f'{self._bag}: {kind} is not installed. Source its package.')
        return self.create_publisher(message_type, target, DEPTH)


def _commands(there: Iterable[str], bag: Path) -> dict[str, str]:
    """Return where to publish the recorded wheel commands, by recorded topic."""
    taken = [topic for topic in there if topic.endswith(TAKEN)]
    if taken:
        return {topic: topic.strip('/') + '_cmd' for topic in taken}
    sent = [topic for topic in there if topic.endswith(SENT)]
    return _chosen(sent or [name.strip('/') for name in TAKEN], there, bag)


def _chosen(names: Iterable[str], there: Iterable[str], bag: Path) -> dict[str, str]:
    """Return where to publish the topics that were asked for; raises BagError."""
    targets = {f'/{name.strip("/")}': name.strip('/') for name in names}
    if missing := [topic for topic in targets if topic not in there]:
        listed = ', '.join(sorted(there)) or 'no messages'
        raise BagError(f'{bag}: no messages on {", ".join(missing)}. The bag holds {listed}.')
    return targets


def _factor(text: str) -> float:
    try:
        rate = float(text)
    except ValueError:
        rate = 0.0
    if not (isfinite(rate) and rate > 0.0):
        raise ArgumentTypeError(f'{text} is not a number above 0')
    return rate


def main(argv: list[str]) -> int:
    """Replay a bag; raises DiffbotError where it cannot be read."""
    options = parser('replay', __doc__ or '', {})
    options.add_argument('bag', type=Path, metavar='BAG', help='folder of a recorded bag')
    options.add_argument('--rate', type=_factor, default=1.0, help='how much faster; default 1')
    options.add_argument('--loop', action='store_true', help='start again at the end')
    options.add_argument(
        '--topics', nargs='+', metavar='TOPIC', help='topics to publish, under their own names'
    )
    chosen = parse(options, argv)
    return run(
        lambda: Replay(chosen.bag, chosen.topics),
        argv,
        lambda node: node.play(chosen.rate, chosen.loop),
    )
