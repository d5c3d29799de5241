"""Record topics to a bag: serialized messages as they come, closed cleanly at the end."""

from collections.abc import Iterable
from datetime import datetime
from functools import partial
from math import inf
from pathlib import Path
from typing import Any, NamedTuple

from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.exceptions import InvalidTopicNameException
from rclpy.logging import get_logger
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, ReliabilityPolicy
from rclpy.validate_topic_name import validate_topic_name

from diffbot_sim.bags.parts import Limits, recording
from diffbot_sim.bags.raw import Offer, Raw, is_standard
from diffbot_sim.errors import ConfigError
from diffbot_sim.nodes import conversions
from diffbot_sim.nodes.parameters import Live, build, table
from diffbot_sim.nodes.quality import profile
from diffbot_sim.nodes.running import overrides, parse, parser, run
from diffbot_sim.nodes.settings import STORAGES, RecorderSettings
from diffbot_sim.nodes.timing import steady_clock
from diffbot_sim.records import NANOSECONDS, SIDES

WRENCH = 'geometry_msgs/msg/WrenchStamped'
# Types of our own topics, to listen before anyone speaks; those of others are asked for.
KNOWN = {
    **{f'{s}_wheel/{n}': WRENCH for s in SIDES for n in ('force', 'force_cmd', 'friction')},
    'odom': 'nav_msgs/msg/Odometry',
    'joint_states': 'sensor_msgs/msg/JointState',
}
LOOK_AGAIN = 0.2  # [s] between looks at who publishes
FLUSH = 1.0  # [s] of messages that may be lost when the process is killed
DEPTH = 1000  # messages that may wait while the disk is busy
# [ns] that a message may have waited for others, sent again; more, and the clock was set back.
LONGEST_WAIT = 30 * NANOSECONDS


class Source(NamedTuple):
    """How a topic is published, as far as a listener must know."""

    kind: str
    offer: Offer


class Recorder(Node):
    """Listens to topics with the quality of service that their publishers offer."""

    def __init__(self, chosen: list[Any]) -> None:
        super().__init__('recorder', parameter_overrides=chosen)
        # Nothing can change while it records.
        known = table(RecorderSettings)
        settings = Live(self, known, partial(build, RecorderSettings), fixed=known).value
        folder = Path(settings.output or f'{datetime.now():rosbag2_%Y_%m_%d-%H_%M_%S}')
        self._sources: dict[str, Source] = {}
        self._listeners: dict[str, Any] = {}
        self._heard: dict[str, int] = {}  # when the last message of a topic came [ns]
        self._early: list[tuple[Raw, Offer]] = []  # what came before the simulation's time
        self._wanted = settings.topics
        _check_names(self._wanted)
        self._look()
        self.create_timer(LOOK_AGAIN, self._look, clock=steady_clock())
        self.create_timer(FLUSH, self._flush, clock=steady_clock())
        # Last of all: a signal that ends the node earlier leaves no bag that lacks its end.
        self._writer = recording(folder, settings.storage, _limits(settings))
        self.get_logger().info(f'recording to {folder}')

    def destroy_node(self) -> None:
        """Finish the bag, then end the node."""
        if hasattr(self, '_writer'):  # some rclpy ends a node that could not open its bag
            self._finish()
        super().destroy_node()

    def _finish(self) -> None:
        # Not the node's own logger: it would complain that /rosout is gone already.
        log = get_logger(f'{self.get_logger().name}.end')
        if self._early:
            log.warning('no /clock came: messages are recorded at the times of their receipt')
        for message, offer in self._early:
            self._writer.write(message, offer)
        self._writer.close()
        if silent := [topic for topic in self._wanted if topic not in self._heard]:
            log.warning(f'nothing came on {", ".join(silent)}')

    def _flush(self) -> None:
        self._writer.flush()

    def _look(self) -> None:
        """Listen to what is published; anew where a publisher offers something else."""
        for topic in self._wanted:
            source = self._source(topic)
            if source is None or source == self._sources.get(topic):
                continue
            if listener := self._listeners.get(topic):
                self.destroy_subscription(listener)
            self._sources[topic] = source
            self._listeners[topic] = self._listen(topic, source)

    def _source(self, topic: str) -> Source | None:
        publishers = self.get_publishers_info_by_topic(topic)
        if not publishers:
            return self._sources.get(topic) or self._expected(topic)
        # The weakest offer: a listener that asks for more hears nothing from that publisher.
        reliable = all(p.qos_profile.reliability == ReliabilityPolicy.RELIABLE for p in publishers)
        kept = all(
            p.qos_profile.durability == DurabilityPolicy.TRANSIENT_LOCAL for p in publishers
        )
        offer = Offer(
            'reliable' if reliable else 'best_effort', 'transient_local' if kept else 'volatile'
        )
        return Source(publishers[0].topic_type, offer)

    def _expected(self, topic: str) -> Source | None:
        """Tell from who else listens what will come, so as not to miss the first message."""
        kinds = [KNOWN[topic]] if topic in KNOWN else []
        kinds += [other.topic_type for other in self.get_subscriptions_info_by_topic(topic)]
        return Source(kinds[0], Offer()) if kinds else None

    def _listen(self, topic: str, source: Source) -> Any:
        kind = conversions.message_type(source.kind) if is_standard(source.kind) else None
        if kind is None:
            self.get_logger().warning(f'{topic}: {source.kind} is not known here; left out')
            return None
        quality = profile(source.offer, DEPTH)
        act = partial(self._on_message, topic, source)
        met = SubscriptionEventCallbacks(matched=partial(self._on_matched, topic))
        return self.create_subscription(kind, topic, act, quality, raw=True, event_callbacks=met)

    def _on_matched(self, topic: str, met: Any) -> None:
        if met.current_count_change > 0:
            self.get_logger().info(f'found {topic}')

    def _on_message(self, topic: str, source: Source, data: bytes, info: Any) -> None:
        if topic not in self._heard:
            self.get_logger().info(f'hears {topic}')
        stamp = self._heard[topic] = self._received(topic, info)
        name = self._listeners[topic].topic_name
        write = self._write_simulated if self._is_simulated() else self._writer.write
        write(Raw(stamp, name, source.kind, data), source.offer)

    def _is_simulated(self) -> bool:
        return bool(self.get_parameter('use_sim_time').value)

    def _write_simulated(self, message: Raw, offer: Offer) -> None:
        """Write a message at the simulation's time; one that comes before that waits for it."""
        now = self.get_clock().now().nanoseconds
        if not now:
            self._early.append((message, offer))
            self.get_logger().info('waits for /clock', once=True)
            return
        for early, offered in self._early:
            self._writer.write(early._replace(stamp=now), offered)
        self._early.clear()
        self._writer.write(message._replace(stamp=now), offer)

    def _received(self, topic: str, info: Any) -> int:
        """Return when a message came [ns]: as the middleware says, for this node may be busy.

        Messages are handed over in order, though after a stall later ones may have come first.
        """
        stamp, last = int(info['received_timestamp']), self._heard.get(topic, 0)
        return last if stamp < last < stamp + LONGEST_WAIT else stamp


def _check_names(topics: Iterable[str]) -> None:
    for topic in topics:
        try:
            validate_topic_name(topic)
        except InvalidTopicNameException as error:
            reason = str(error).splitlines()[0].removeprefix('Invalid topic name: ').rstrip(':')
            raise ConfigError(f"topics: '{topic}' is no name of a topic: {reason}") from error


def _limits(settings: RecorderSettings) -> Limits:
    return Limits(settings.max_bag_size or inf, settings.max_bag_duration or inf)


def main(argv: list[str]) -> int:
    """Record until told to stop; raises DiffbotError where the bag cannot be written."""
    options = parser('recorder', __doc__ or '', table(RecorderSettings))
    options.add_argument('-o', '--output', metavar='DIR', help='folder of the new bag')
    options.add_argument('--topics', nargs='+', metavar='TOPIC', help='topics to record')
    options.add_argument('-s', '--storage', choices=STORAGES, help='kind of file; default mcap')
    options.add_argument(
        '-b',
        '--max-bag-size',
        type=int,
        metavar='BYTES',
        help='size that makes it start another file',
    )
    options.add_argument(
        '-d',
        '--max-bag-duration',
        type=float,
        metavar='SECONDS',
        help='duration after which it starts another file',
    )
    chosen = overrides(RecorderSettings, parse(options, argv))
    return run(lambda: Recorder(chosen), argv)
