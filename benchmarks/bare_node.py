"""A node without a robot: publishes the simulator's messages from a timer, and does no more."""

import sys
from collections.abc import Callable
from contextlib import suppress

import rclpy
from geometry_msgs.msg import WrenchStamped
from nav_msgs.msg import Odometry
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from sensor_msgs.msg import JointState

FORCES = [f'{side}_wheel/{name}' for side in ('right', 'left') for name in ('force', 'friction')]
KINDS = {'odom': Odometry, 'joint_states': JointState, **dict.fromkeys(FORCES, WrenchStamped)}


class Bare(Node):
    """Keeps its messages, renews their stamps, and tells the forces that it hears."""

    def __init__(self, rate: float) -> None:
        super().__init__('bare')
        self._messages = {topic: kind() for topic, kind in KINDS.items()}
        self._fill()
        self._outlets = {t: self.create_publisher(kind, t, 100) for t, kind in KINDS.items()}
        for side in ('right', 'left'):
            told = self._messages[f'{side}_wheel/force']
            self.create_subscription(
                WrenchStamped, f'{side}_wheel/force_cmd', self._teller(told), 10
            )
        self.create_timer(1.0 / rate, self._tick)

    def _fill(self) -> None:
        for message in self._messages.values():
            message.header.frame_id = 'right_wheel_contact'
        self._messages['odom'].child_frame_id = 'base_link'
        joints = self._messages['joint_states']
        joints.name = ['right_wheel_joint', 'left_wheel_joint']
        joints.position = joints.velocity = joints.effort = [0.0, 0.0]

    def _teller(self, told: WrenchStamped) -> Callable[[WrenchStamped], None]:
        def tell(message: WrenchStamped) -> None:
            told.wrench.force.x = message.wrench.force.x

        return tell

    def _tick(self) -> None:
        stamp = self.get_clock().now().to_msg()
        for topic, message in self._messages.items():
            message.header.stamp = stamp
            self._outlets[topic].publish(message)


if __name__ == '__main__':
    rclpy.init()
    with suppress(ExternalShutdownException):
        rclpy.spin(Bare(float(sys.argv[1])))
