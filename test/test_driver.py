"""`driver` as a process: what its twists say, and when its drive is over."""

import pytest
from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
from ros_robot import PATIENCE, Robot, ros, running

from diffbot_sim.nodes import conversions

SECOND = 10**9
WORDS = ('-p', 'stamped:=true', '-p', 'duration:=20.0')


def odometry(second: int) -> Odometry:
    message = Odometry(child_frame_id='r/base_link')
    message.header.frame_id = 'r/odom'
    message.header.stamp = conversions.time(second * SECOND)
    return message


@pytest.fixture(scope='module')
def driven(tmp_path_factory):
    """Start a driver, and who tells it where the robot is."""
    log = tmp_path_factory.mktemp('driver') / 'log'
    with Robot('driven') as robot, running(log, *ros('driver', 'driven', *WORDS)) as process:
        robot.collect(TwistStamped, 'cmd_vel')
        yield robot, process


def answer(robot: Robot, second: int) -> TwistStamped:
    """Tell the driver of a moment; return the twist that answers it."""
    stamp = odometry(second).header.stamp
    heard = robot.heard['cmd_vel']
    heard.clear()
    with robot.publishing('odom', odometry(second)):
        robot.until(lambda: any(message.header.stamp == stamp for message in heard))
    return heard[-1]


def test_twists_are_of_the_robot_and_of_the_odometry_that_they_answer(driven):
    header = answer(driven[0], 5).header
    assert (header.frame_id, conversions.nanoseconds(header.stamp)) == ('r/base_link', 5 * SECOND)


def test_a_drive_begins_anew_where_time_jumps_back_and_ends(driven):
    robot, process = driven
    for second in (5, 24, 3, 22):  # 19 s after its beginning, twice
        answer(robot, second)
    with robot.publishing('odom', odometry(24)):
        robot.until(lambda: process.process.poll() is not None, PATIENCE)
    assert process.process.returncode == 0
