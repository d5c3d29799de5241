"""Drive a robot so that its bag shows everything: cmd_vel with steps, arcs, turns and stops."""

from functools import partial

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
        self._first: int | None = None
        self._stamped = chosen.stamped
        kind = TwistStamped if chosen.stamped else Twist
        self._command = self.create_publisher(kind, 'cmd_vel', DEPTH)
        self.create_subscription(Odometry, 'odom', self._on_odometry, DEPTH)
        self.get_logger().info(f'driving for {self._duration:g} s once odometry comes')

    def _on_odometry(self, message: Odometry) -> None:
        stamp = conversions.nanoseconds(message.header.stamp)
        self._first = stamp if self._first is None else self._first
        elapsed = (stamp - self._first) / NANOSECONDS
        command = conversions.twist(*twist_at(self._segments, elapsed))
        if self._stamped:
            command = TwistStamped(header=message.header, twist=command)
        self._command.publish(command)
        if elapsed > self._duration:
            self.get_logger().info('the drive is over')
            raise ExternalShutdownException


def main(argv: list[str]) -> int:
    """Drive until the drive is over or the node is told to stop."""
    parse(parser('driver', __doc__ or '', table(DriverSettings)), argv)
    return run(Driver, argv)
