"""What the simulator publishes at each tick."""

from typing import Any

from geometry_msgs.msg import WrenchStamped
from nav_msgs.msg import Odometry
from rclpy.event_handler import PublisherEventCallbacks
from rclpy.node import Node
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState

from diffbot_sim.nodes import conversions
from diffbot_sim.nodes.odometer import Odometer
from diffbot_sim.nodes.settings import SimulatorSettings
from diffbot_sim.physics import Plant
from diffbot_sim.records import CONTACT_FRAMES, SIDES, Pair

DEPTH = 10
# Messages kept for a listener that is busy, so that a recording on a busy machine has no gap.
KEPT = 1000
UNWATCHED = PublisherEventCallbacks(use_default_callbacks=False)


class Outputs:
    """The publishers of the simulator; those for clock and tf where they are asked for."""

    def __init__(self, node: Node, settings: SimulatorSettings) -> None:
        self._prefix = settings.frame_prefix
        self._force = _per_wheel(node, 'force')
        self._friction = _per_wheel(node, 'friction')
        self._odom = _publisher(node, Odometry, 'odom', KEPT)
        self._joints = _publisher(node, JointState, 'joint_states', KEPT)
        self._clock = _publisher(node, Clock, '/clock', DEPTH) if settings.publish_clock else None
        self._tf = _tf_publisher(node) if settings.enable_odom_tf else None
        self._last, self._joint_state = Odometry(), JointState(name=conversions.JOINTS)

    @property
    def world(self) -> str:
        """The frame that poses are told in."""
        return self._prefix + conversions.WORLD

    def publish_motion(self, stamp: int, plant: Plant, odometer: Odometer) -> None:
        """Tell the true pose with the measured twist at a stamp [ns]."""
        if self._clock:
            self._clock.publish(conversions.clock(stamp))
        conversions.odometry(
            stamp,
            plant.pose,
            odometer.measure(plant.twist),
            odometer.pose_covariance,
            odometer.twist_covariance,
            self._prefix,
            into=self._last,
        )
        self.repeat()

    def repeat(self) -> None:
        """Tell the last motion, again."""
        self._odom.publish(self._last)
        if self._tf:
            transforms, publisher = self._tf
            publisher.publish(transforms(transforms=[conversions.transform(self._last)]))

    def publish_forces(self, stamp: int, plant: Plant, force: Pair) -> None:
        """Tell the forces [N] held from a stamp [ns] on, what they meet, and the wheels."""
        for values, outlets in ((force, self._force), (plant.friction, self._friction)):
            for side, value, (publisher, message) in zip(SIDES, values, outlets, strict=True):
                frame = self._prefix + CONTACT_FRAMES[side]
                publisher.publish(conversions.wrench(stamp, frame, value, into=message))
        self._publish_joints(stamp, plant)

    def _publish_joints(self, stamp: int, plant: Plant) -> None:
        radius = plant.model.robot.wheel_radius
        right, left = plant.wheel_speed
        rate = (right / radius, left / radius)
        right, left = plant.traction
        torque = (right * radius, left * radius)
        conversions.joint_state(stamp, plant.wheel_angle, rate, torque, into=self._joint_state)
        self._joints.publish(self._joint_state)


def _publisher(node: Node, kind: Any, topic: str, depth: int) -> Any:
    """Return a publisher that does not watch who asks for a QoS that it does not offer.

    The one who asks is told. Watching would cost a third of the node's time.
    """
    return node.create_publisher(kind, topic, depth, event_callbacks=UNWATCHED)


def _per_wheel(node: Node, name: str) -> tuple[tuple[Any, WrenchStamped], ...]:
    """Return a publisher and its message for each wheel."""
    return tuple(
        (_publisher(node, WrenchStamped, f'{side}_wheel/{name}', KEPT), WrenchStamped())
        for side in SIDES
    )


def _tf_publisher(node: Node) -> tuple[Any, Any] | None:
    """Return the message class and its publisher, or None where tf2_msgs is not installed."""
    try:
        from tf2_msgs.msg import TFMessage
    except ImportError:
        node.get_logger().warning('enable_odom_tf: tf2_msgs is not installed; no tf is published')
        return None
    return TFMessage, _publisher(node, TFMessage, 'tf', KEPT)
