"""What goes into a message comes out of it."""

from math import pi

import numpy as np
import pytest
from geometry_msgs.msg import Twist, TwistStamped, WrenchStamped
from hypothesis import given
from hypothesis import strategies as st
from nav_msgs.msg import Odometry

from diffbot_sim.nodes import conversions
from diffbot_sim.nodes.odometer import Odometer
from diffbot_sim.nodes.settings import OdometryNoise

NOISE = OdometryNoise(linear=0.1, angular=0.2, seed=3)
numbers = st.floats(-1e6, 1e6)


def odometry(pose, twist):
    odometer = Odometer(OdometryNoise(), floor=1e-9)
    covariances = odometer.pose_covariance, odometer.twist_covariance
    return conversions.odometry(5, pose, twist, *covariances)


@given(st.integers(0, 2**31 * 10**9 - 1))
def test_stamps_survive_to_the_nanosecond(stamp):
    assert conversions.nanoseconds(conversions.time(stamp)) == stamp


@given(numbers, numbers, st.floats(-3.14, 3.14), numbers, numbers)
def test_odometry_keeps_pose_and_twist(x, y, heading, v, omega):
    message = odometry((x, y, heading), (v, omega))
    assert conversions.twist_of(message) == (v, omega)
    assert conversions.pose_of(message) == pytest.approx((x, y, heading))


def test_a_heading_of_many_turns_is_the_same_orientation():
    message = odometry((0.0, 0.0, 1.0 + 6 * pi), (0.0, 0.0))
    assert conversions.pose_of(message)[2] == pytest.approx(1.0)


def test_odometry_has_the_frames_of_rep_105_and_a_covariance():
    message = odometry((0.0, 0.0, 0.0), (0.0, 0.0))
    assert (message.header.frame_id, message.child_frame_id) == ('odom', 'base_link')
    assert message.pose.covariance.reshape(6, 6).diagonal().min() > 0.0
    assert message.twist.covariance.reshape(6, 6).diagonal().min() > 0.0


def test_the_transform_says_what_odometry_says():
    message = odometry((1.0, 2.0, 0.3), (0.0, 0.0))
    transform = conversions.transform(message)
    assert transform.transform.translation.y == 2.0
    assert transform.transform.rotation == message.pose.pose.orientation
    assert transform.child_frame_id == 'base_link'


def test_twists_are_read_from_every_message_that_holds_one():
    plain, stamped, odom = Twist(), TwistStamped(), Odometry()
    for twist in (plain, stamped.twist, odom.twist.twist):
        twist.linear.x, twist.angular.z = 1.0, 2.0
    assert {conversions.twist_of(message) for message in (plain, stamped, odom)} == {(1.0, 2.0)}


def test_a_wrench_keeps_its_force():
    message = conversions.wrench(7, 'left_wheel_contact', -2.5)
    assert conversions.force_of(message) == -2.5
    assert message.header.frame_id == 'left_wheel_contact'


def test_message_types_are_found_by_name():
    assert conversions.message_type('geometry_msgs/msg/WrenchStamped') is WrenchStamped
    assert conversions.message_type('no_msgs/msg/Such') is None


def test_noise_is_seeded_and_as_large_as_its_covariance_says():
    first, second = Odometer(NOISE, 1e-9), Odometer(NOISE, 1e-9)
    drawn = np.array([first.measure((1.0, 0.0)) for _ in range(4000)])
    assert second.measure((1.0, 0.0)) == tuple(drawn[0])
    variance = first.twist_covariance.reshape(6, 6).diagonal()[[0, 5]]
    np.testing.assert_allclose(drawn.var(axis=0), variance, rtol=0.1)


def test_without_noise_a_resting_robot_measures_exactly_zero():
    assert Odometer(OdometryNoise(), 1e-9).measure((0.0, 0.0)) == (0.0, 0.0)
