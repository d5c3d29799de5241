"""Numbers to messages and back: the only module that knows their fields."""

from typing import Any

import numpy as np
from rosbags.typesys import Stores, get_typestore

from diffbot_sim.records import NANOSECONDS, Array

ODOMETRY = 'nav_msgs/msg/Odometry'
WRENCH = 'geometry_msgs/msg/WrenchStamped'

STORE = get_typestore(Stores.ROS2_JAZZY)
_TYPES = STORE.types
_Vector = _TYPES['geometry_msgs/msg/Vector3']
_Twist = _TYPES['geometry_msgs/msg/Twist']
# Filters take a variance of 0 for certainty; this one says: predicted, not measured.
_COVARIANCE = np.diag(np.full(6, 1e-6)).ravel()


def wrench_row(message: Any) -> tuple[float, ...]:
    """Return force.x [N]."""
    return (message.wrench.force.x,)


def odometry_row(message: Any) -> tuple[float, ...]:
    """Return v [m/s], ω [rad/s], x, y [m] and the quaternion x, y, z, w."""
    twist, pose = message.twist.twist, message.pose.pose
    q = pose.orientation
    return (twist.linear.x, twist.angular.z, pose.position.x, pose.position.y, q.x, q.y, q.z, q.w)


def yaw(quaternion: Array) -> Array:
    """Return the yaw [rad] of quaternions x, y, z, w of any length but 0, shape (k, 4)."""
    x, y, z, w = quaternion.T
    angle: Array = np.arctan2(2.0 * (w * z + x * y), w * w + x * x - y * y - z * z)
    return angle


def wrench(stamp: int, frame: str, force: float, torque: float = 0.0) -> Any:
    """Build a WrenchStamped: stamp [ns], force along x [N], torque about z [N·m]."""
    value = _TYPES['geometry_msgs/msg/Wrench'](_vector(x=force), _vector(z=torque))
    return _TYPES[WRENCH](_header(stamp, frame), value)


def twist(stamp: int, v: float, omega: float) -> Any:
    """Build a TwistStamped: stamp [ns], v [m/s], omega [rad/s]."""
    return _TYPES['geometry_msgs/msg/TwistStamped'](_header(stamp, 'base_link'), _twist(v, omega))


def odometry(stamp: int, motion: Array, place: Array | None) -> Any:
    """Build an Odometry: stamp [ns], motion (v, ω), place (x, y, yaw).

    Without a place the quaternion is all zero, which says that it is no orientation.
    """
    x, y, heading = (0.0, 0.0, 0.0) if place is None else map(float, place)
    size = 0.0 if place is None else 1.0
    turn = _TYPES['geometry_msgs/msg/Quaternion'](
        0.0, 0.0, size * np.sin(heading / 2.0), size * np.cos(heading / 2.0)
    )
    pose = _TYPES['geometry_msgs/msg/Pose'](_TYPES['geometry_msgs/msg/Point'](x, y, 0.0), turn)
    return _TYPES[ODOMETRY](
        _header(stamp, 'odom'),
        'base_link',
        _TYPES['geometry_msgs/msg/PoseWithCovariance'](pose, _COVARIANCE),
        _TYPES['geometry_msgs/msg/TwistWithCovariance'](_twist(*map(float, motion)), _COVARIANCE),
    )


def _header(stamp: int, frame: str) -> Any:
    seconds, rest = divmod(stamp, NANOSECONDS)
    time = _TYPES['builtin_interfaces/msg/Time'](seconds, rest)
    return _TYPES['std_msgs/msg/Header'](time, frame)


def _vector(x: float = 0.0, z: float = 0.0) -> Any:
    return _Vector(x, 0.0, z)


def _twist(v: float, omega: float) -> Any:
    return _Twist(_vector(x=v), _vector(z=omega))
