"""Messages to plain values and back; stamps are nanoseconds, wheels are right then left.

`into` is a message to fill, which is far quicker than making one.
"""

from importlib import import_module
from math import atan2, cos, sin
from typing import Any

from builtin_interfaces.msg import Time
from geometry_msgs.msg import (
    PoseWithCovarianceStamped,
    TransformStamped,
    Twist,
    TwistStamped,
    WrenchStamped,
)
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState

from diffbot_sim.records import NANOSECONDS, Array, Pair

WORLD, BODY = 'odom', 'base_link'
JOINTS = ['right_wheel_joint', 'left_wheel_joint']


def time(stamp: int) -> Time:
    """Return a stamp [ns] as message."""
    seconds, rest = divmod(stamp, NANOSECONDS)
    return Time(sec=seconds, nanosec=rest)


def nanoseconds(message: Time) -> int:
    """Return a stamp [ns]."""
    return int(message.sec * NANOSECONDS + message.nanosec)


def clock(stamp: int) -> Clock:
    """Return simulation time for /clock."""
    return Clock(clock=time(stamp))


def wrench(
    stamp: int, frame: str, force: float, into: WrenchStamped | None = None
) -> WrenchStamped:
    """Return a force [N] along x of a frame."""
    message = into or WrenchStamped()
    message.header.stamp = time(stamp)
    message.header.frame_id = frame
    message.wrench.force.x = force
    return message


def force_of(message: WrenchStamped) -> float:
    """Return the force [N] along x."""
    return float(message.wrench.force.x)


def twist_of(message: Twist | TwistStamped | Odometry) -> Pair:
    """Return v [m/s] and ω [rad/s]."""
    twist = message
    while not isinstance(twist, Twist):
        twist = twist.twist
    return float(twist.linear.x), float(twist.angular.z)


def twist(v: float, omega: float) -> Twist:
    """Return a twist of v [m/s] forward and ω [rad/s]."""
    message = Twist()
    message.linear.x, message.angular.z = v, omega
    return message


def wheel_rate(stamp: int, frame: str, rate: float) -> TwistStamped:
    """Return the angular speed [rad/s] of a wheel, positive forward."""
    message = TwistStamped()
    message.header.stamp = time(stamp)
    message.header.frame_id = frame
    message.twist.angular.y = rate
    return message


def wheel_rate_of(message: TwistStamped) -> float:
    """Return the angular speed [rad/s] of a wheel, positive forward."""
    return float(message.twist.angular.y)


def odometry(
    stamp: int,
    pose: tuple[float, float, float],
    twist: Pair,
    pose_covariance: Array,
    twist_covariance: Array,
    frame_prefix: str = '',
    into: Odometry | None = None,
) -> Odometry:
    """Return x, y [m], heading [rad] and v [m/s], ω [rad/s] with flat 6x6 covariances."""
    message = into or Odometry()
    message.header.stamp = time(stamp)
    message.header.frame_id = frame_prefix + WORLD
    message.child_frame_id = frame_prefix + BODY
    place, turn = message.pose.pose.position, message.pose.pose.orientation
    place.x, place.y, heading = pose
    turn.z, turn.w = sin(heading / 2.0), cos(heading / 2.0)
    message.twist.twist.linear.x, message.twist.twist.angular.z = twist
    message.pose.covariance, message.twist.covariance = pose_covariance, twist_covariance
    return message


def frame_prefix_of(message: Odometry) -> str:
    """Return what stands before the names of a robot's frames."""
    frame = message.child_frame_id
    return frame.removesuffix(BODY) if frame.endswith(BODY) else ''


def pose_of(message: Odometry | PoseWithCovarianceStamped) -> tuple[float, float, float]:
    """Return x, y [m] and the heading [rad, -π to π]."""
    place, turn = message.pose.pose.position, message.pose.pose.orientation
    return place.x, place.y, atan2(2.0 * turn.w * turn.z, turn.w**2 - turn.z**2)


def transform(message: Odometry) -> TransformStamped:
    """Return the pose of an odometry message as transform."""
    place, turn = message.pose.pose.position, message.pose.pose.orientation
    result = TransformStamped(header=message.header, child_frame_id=message.child_frame_id)
    result.transform.translation.x, result.transform.translation.y = place.x, place.y
    result.transform.rotation = turn
    return result


def joint_state(
    stamp: int, angle: Pair, rate: Pair, torque: Pair, into: JointState | None = None
) -> JointState:
    """Return angles [rad], rates [rad/s] and torques [N·m] of the wheels."""
    message = into or JointState(name=JOINTS)
    message.header.stamp = time(stamp)
    message.position, message.velocity, message.effort = angle, rate, torque
    return message


def message_type(name: str) -> Any:
    """Return the class of a type like 'nav_msgs/msg/Odometry', None where it is not installed."""
    package, _, kind = name.split('/')
    try:
        return getattr(import_module(f'{package}.msg'), kind, None)
    except ImportError:
        return None
