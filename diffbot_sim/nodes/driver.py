"""Drive a robot so that its bag shows everything: cmd_vel with steps, arcs, turns and stops."""

from functools import partial
from math import inf

from geometry_msgs.msg import Twist, TwistStamped
from nav_msgs.msg import Odometry
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node

from diffbot_sim.control.excitation import excitation, twist_at
from diffbot_sim.nodes import conversions
from diffbot_sim.nodes.outputs import DEPTH
from diffbot_sim.nodes.parameters import Live, build, table
from diffbot_sim.nodes.running import parse, parser, run
from diffbot_sim.nodes.settings import DriverSettings
from diffbot_sim.records import NANOSECONDS


class Driver(Node):
    """Answers each odometry message with a twist, so it keeps time with the robot's clock."""

    def __init__(self) -> None:
        super().__init__('driver')
        known = table(DriverSettings)
        chosen = Live(self, known, partial(build, DriverSettings), fixed=known).value
        self._duration = chosen.duration
        self._segments = excitation(
            chosen.seed, chosen.duration, chosen.fastest, chosen.fastest_turn
        )
        self._first, self._last = 0, inf  # stamps [ns] of the first and the last odometry
        self._stamped = chosen.stamped
        kind = TwistStamped if chosen.stamped else Twist
        self._command = self.create_publisher(kind, 'cmd_vel', DEPTH)
        self.create_subscription(Odometry, 'odom', self._on_odometry, DEPTH)
        self.get_logger().info(f'driving for {self._duration:g} s once odometry comes')

    def _on_odometry(self, message: Odometry) -> None:
        stamp = conversions.nanoseconds(message.header.stamp)
        if stamp < self._last:  # the first one, or time jumped back
            self._first = stamp
        self._last = stamp
        elapsed = (stamp - self._first) / NANOSECONDS
        command = conversions.twist(*twist_at(self._segments, elapsed))
        if self._stamped:
            command = TwistStamped(twist=command)
            command.header.stamp = message.header.stamp
            command.header.frame_id = message.child_frame_id
        self._command.publish(command)
        if elapsed > self._duration:
            self.get_logger().info('the drive is over')
            raise ExternalShutdownException


def main(argv: list[str]) -> int:
    """Drive until the drive is over or the node is told to stop."""
    parse(parser('driver', __doc__ or '', table(DriverSettings)), argv)
    return run(Driver, argv)
