"""`driver` as a process: what its twists say, and when its drive is over."""

import pytest
from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
from ros_robot import PATIENCE, Robot, ros, running

from diffbot_sim.nodes import conversions
from diffbot_sim.records import NANOSECONDS

WORDS = ('-p', 'stamped:=true', '-p', 'duration:=20.0')


def odometry(second: int) -> Odometry:
    message = Odometry(child_frame_id='r/base_link')
    message.header.frame_id = 'r/odom'
    message.header.stamp = conversions.time(second * NANOSECONDS)
    return message


@pytest.fixture(scope='module')
def driven(tmp_path_factory):
    """Start a driver, and who tells it where the robot is."""
    log = tmp_path_factory.mktemp('driver') / 'log'
    with Robot('driven') as robot, running(log, *ros('driver', 'driven', *WORDS)) as process:
        robot.collect(TwistStamped, 'cmd_vel')
        yield robot, process


def test_twists_are_of_the_robot_and_of_the_odometry_that_they_answer(driven):
    header = driven[0].answer('cmd_vel', odometry(5)).header
    stamp = conversions.nanoseconds(header.stamp)
    assert (header.frame_id, stamp) == ('r/base_link', 5 * NANOSECONDS)


def test_a_drive_begins_anew_where_time_jumps_back_and_ends(driven):
    robot, process = driven
    for second in (5, 24, 3, 22):  # 19 s after its beginning, twice
        robot.answer('cmd_vel', odometry(second))
    with robot.publishing('odom', odometry(24)):
        robot.until(lambda: process.process.poll() is not None, PATIENCE)
    assert process.process.returncode == 0
