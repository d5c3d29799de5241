"""What the simulator publishes at each tick."""

from typing import Any

from geometry_msgs.msg import WrenchStamped
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState

from diffbot_sim.nodes import conversions
from diffbot_sim.nodes.conversions import Pair
from diffbot_sim.nodes.odometer import Odometer
from diffbot_sim.physics import Plant

SIDES = ('right', 'left')
DEPTH = 10
# Messages kept for a listener that is busy, so that a recording on a busy machine has no gap.
KEPT = 100


class Outputs:
    """The publishers of the simulator; those for clock and tf where they are asked for."""

    def __init__(self, node: Node, with_clock: bool, with_tf: bool) -> None:
        self._force = _per_wheel(node, 'force')
        self._friction = _per_wheel(node, 'friction')
        self._odom = node.create_publisher(Odometry, 'odom', KEPT)
        self._joints = node.create_publisher(JointState, 'joint_states', KEPT)
        self._clock = node.create_publisher(Clock, '/clock', DEPTH) if with_clock else None
        self._tf = _tf_publisher(node) if with_tf else None

    def publish(self, stamp: int, plant: Plant, force: Pair, odometer: Odometer) -> None:
        """Tell the plant's state at a stamp [ns], and the forces [N] held from there on."""
        if self._clock:
            self._clock.publish(conversions.clock(stamp))
        for values, publishers in ((force, self._force), (plant.friction, self._friction)):
            for side, value, publisher in zip(SIDES, values, publishers, strict=True):
                publisher.publish(conversions.wrench(stamp, f'{side}_wheel_contact', value))
        self._publish_motion(stamp, plant, odometer)
        self._publish_joints(stamp, plant, force)

    def _publish_motion(self, stamp: int, plant: Plant, odometer: Odometer) -> None:
        """Publish the true pose with the measured twist."""
        message = conversions.odometry(
            stamp,
            plant.pose,
            odometer.measure(plant.twist),
            odometer.pose_covariance,
            odometer.twist_covariance,
        )
        self._odom.publish(message)
        if self._tf:
            transforms, publisher = self._tf
            publisher.publish(transforms(transforms=[conversions.transform(message)]))

    def _publish_joints(self, stamp: int, plant: Plant, force: Pair) -> None:
        radius = plant.model.robot.wheel_radius
        right, left = plant.wheel_speed
        rate = (right / radius, left / radius)
        torque = (force[0] * radius, force[1] * radius)
        self._joints.publish(conversions.joint_state(stamp, plant.wheel_angle, rate, torque))


def _per_wheel(node: Node, name: str) -> tuple[Any, ...]:
    return tuple(node.create_publisher(WrenchStamped, f'{s}_wheel/{name}', KEPT) for s in SIDES)


def _tf_publisher(node: Node) -> tuple[Any, Any] | None:
    """Return the message class and its publisher, or None where tf2_msgs is not installed."""
    try:
        from tf2_msgs.msg import TFMessage
    except ImportError:
        node.get_logger().warning('enable_odom_tf: tf2_msgs is not installed; no tf is published')
        return None
    return TFMessage, node.create_publisher(TFMessage, 'tf', KEPT)
