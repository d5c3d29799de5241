"""Waits for recorded moments, minding keyboard and /clock as `ros2 bag play` does."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from time import monotonic

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rosgraph_msgs.msg import Clock

from diffbot_sim.nodes import conversions
from diffbot_sim.nodes.keys import pressed_keys
from diffbot_sim.nodes.pace import Pace
from diffbot_sim.nodes.playhead import Playhead

DEPTH = 10
SOON = 0.05  # [s] between looks at the keyboard
PAUSE, NEXT = ' ', ('.', '\x1b[C')  # the space bar; a dot or the right arrow
HELP = 'At a terminal the space bar pauses and resumes; . or → plays the next message.'


class Transport:
    """Recorded time for a node that replays: it runs, is paused and jumps."""

    def __init__(self, node: Node, rate: float, clock: float | None) -> None:
        """Run at a rate; publish /clock at a frequency [Hz] of wall time, or not at all."""
        self._node, self._head = node, Playhead(rate)
        self._clock = node.create_publisher(Clock, '/clock', DEPTH) if clock else None
        self._pace = Pace(1.0 / clock if clock else SOON, monotonic())
        self._pressed: Callable[[], str] = _nothing

    @contextmanager
    def keyboard(self) -> Iterator[None]:
        """Obey the keyboard inside the block."""
        with pressed_keys() as self._pressed:
            yield
        self._pressed = _nothing

    def start_at(self, stamp: int) -> None:
        """Jump to a recorded moment [ns]."""
        self._head.jump(stamp)
        self._tell_time()

    def wait_for(self, stamp: int) -> None:
        """Let a recorded moment [ns] come; raises ExternalShutdownException at a signal.

        While paused it comes by a key alone.
        """
        while not self._attend(stamp) and (left := self._head.until(stamp)) > 0.0:
            spin(self._node, min(left, SOON, self._pace.left(monotonic())))

    def _attend(self, stamp: int) -> bool:
        """Do what is due; say whether a key plays the next message, that of `stamp` [ns]."""
        if not rclpy.ok():
            raise ExternalShutdownException
        if self._pace.due(monotonic())[0]:
            self._tell_time()
        key = self._pressed()
        if key == PAUSE:
            self._head.toggle()
            self._node.get_logger().info('paused' if self._head.is_paused else 'resumed')
        plays = key in NEXT and self._head.is_paused
        if plays:
            self._head.jump(stamp)
        return plays

    def _tell_time(self) -> None:
        if self._clock:
            self._clock.publish(conversions.clock(self._head.now))


def _nothing() -> str:
    """Press no key."""
    return ''


def spin(node: Node, seconds: float) -> None:
    """Let the node work for a while; raises ExternalShutdownException at a signal."""
    rclpy.spin_once(node, timeout_sec=max(seconds, 0.0))
    if not rclpy.ok():
        raise ExternalShutdownException
