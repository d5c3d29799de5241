"""Publish what a bag recorded, at its recorded spacing: by default the wheel commands."""

from argparse import ArgumentTypeError
from math import isfinite
from pathlib import Path
from time import monotonic
from typing import Any

from rclpy.duration import Duration
from rclpy.node import Node

from diffbot_sim.bags.raw import USUAL, Offer, kept_topics, raw_messages, span_of, topics_in
from diffbot_sim.errors import BagError
from diffbot_sim.nodes import conversions
from diffbot_sim.nodes.quality import profile
from diffbot_sim.nodes.running import parse, parser, run
from diffbot_sim.nodes.targets import chosen, commands
from diffbot_sim.nodes.transport import HELP, SOON, Transport, spin
from diffbot_sim.records import NANOSECONDS

DEPTH = 1000
KEPT = Offer(durability='transient_local')
PATIENCE = 5.0  # [s] to wait for listeners
CLOCK = 40.0  # [Hz] of /clock where nobody says; that of `ros2 bag play`


class Replay(Node):
    """Publishes serialized messages, each topic in the node's namespace."""

    def __init__(self, bag: Path, asked: list[str] | None, offset: float) -> None:
        super().__init__('replay')
        self._bag, self._start = bag, _moment(bag, offset)
        there = topics_in(bag)
        targets = chosen(asked, there, bag) if asked else commands(there, bag)
        kept = kept_topics(bag)
        self._outlets = {
            topic: self._outlet(there[topic], target, KEPT if topic in kept else USUAL)
            for topic, target in targets.items()
        }
        if next(raw_messages(bag, self._outlets, self._start), None) is None:
            nothing = f'{bag}: nothing on {", ".join(self._outlets)} after {offset:g} s'
            raise BagError(f'{nothing}; choose a smaller --start-offset.')

    def play(self, transport: Transport, loop: bool) -> None:
        """Publish the bag from the chosen moment to its end."""
        self._await_listeners()
        self.get_logger().info(f'replaying {", ".join(self._outlets)} of {self._bag}')
        with transport.keyboard():
            self._play_once(transport)
            while loop:
                self._play_once(transport)
        for outlet in self._outlets.values():
            outlet.wait_for_all_acked(Duration(seconds=1))
        self.get_logger().info('done')

    def _play_once(self, transport: Transport) -> None:
        first = True
        for message in raw_messages(self._bag, self._outlets, self._start):
            if first:
                transport.start_at(message.stamp)
            first = False
            transport.wait_for(message.stamp)
            self._outlets[message.topic].publish(message.data)

    def _await_listeners(self) -> None:
        """Wait until someone hears each topic: what nobody hears at the start is lost."""
        patience = monotonic() + PATIENCE
        while (deaf := self._unheard()) and monotonic() < patience:
            spin(self, SOON)
        if deaf:
            self.get_logger().warning(f'nobody listens to {", ".join(deaf)}')

    def _unheard(self) -> list[str]:
        outlets = self._outlets.values()
        return [item.topic_name for item in outlets if not item.get_subscription_count()]

    def _outlet(self, kind: str, target: str, offer: Offer) -> Any:
        message_type = conversions.message_type(kind)
        if message_type is None:
            raise BagError(f'{self._bag}: {kind} is not installed. Source its package.')
        return self.create_publisher(message_type, target, profile(offer, DEPTH))


def _moment(bag: Path, offset: float) -> int:
    """Return the recorded moment [ns] so long after the beginning [s]; raises BagError."""
    first, last = span_of(bag)
    if offset * NANOSECONDS > max(last - first, 0):
        length = (last - first) / NANOSECONDS
        raise BagError(f'{bag}: lasts {length:.1f} s; choose a --start-offset below that.')
    return first + round(offset * NANOSECONDS)


def _above_zero(text: str) -> float:
    if (value := _from_zero(text)) == 0.0:
        raise ArgumentTypeError(f'{text} is not a number above 0')
    return value


def _from_zero(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if not (isfinite(value) and value >= 0.0):
        raise ArgumentTypeError(f'{text} is not a number from 0 on')
    return value


def main(argv: list[str]) -> int:
    """Replay a bag; raises DiffbotError where it cannot be read."""
    options = parser('replay', f'{__doc__}\n\n{HELP}', {})
    add = options.add_argument
    add('bag', type=Path, metavar='BAG', help='folder of a recorded bag')
    add('--rate', type=_above_zero, default=1.0, help='how much faster; default 1')
    add('--loop', action='store_true', help='start again at the end')
    add('--topics', nargs='+', metavar='TOPIC', help='to publish, under their own names')
    add('--start-offset', type=_from_zero, default=0.0, metavar='SECONDS', help='to skip')
    about = f'publish the recorded time on /clock; default {CLOCK:g} Hz'
    add('--clock', type=_above_zero, nargs='?', const=CLOCK, metavar='HZ', help=about)
    words = parse(options, argv)
    return run(
        lambda: Replay(words.bag, words.topics, words.start_offset),
        argv,
        lambda node: node.play(Transport(node, words.rate, words.clock), words.loop),
    )
