"""`pi_controller` as a process without a robot: what it does when odometry's time jumps."""

from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
from ros_robot import Robot, ros, running

from diffbot_sim.nodes import conversions
from diffbot_sim.records import NANOSECONDS


def reference_at(robot: Robot, second: int) -> float:
    """Tell of odometry at a moment; return the reference [rad/s] that answers it."""
    message = Odometry()
    message.header.stamp = conversions.time(second * NANOSECONDS)
    answer = robot.answer('right_wheel/velocity_reference', message)
    return float(answer.twist.angular.y)


def test_a_reference_that_ran_out_stays_so_where_time_jumps_back(tmp_path):
    asked = TwistStamped()
    asked.twist.angular.y = 5.0
    with (
        Robot('jumping') as robot,
        running(tmp_path / 'log', *ros('pi_controller', 'jumping')),
    ):
        robot.collect(TwistStamped, 'right_wheel/velocity_reference')
        with robot.publishing('right_wheel/velocity_cmd', asked):
            robot.until(lambda: reference_at(robot, 10) == 5.0)
        reference_at(robot, 11)  # by now the last command has come
        assert [reference_at(robot, second) for second in (12, 2)] == [0.0, 0.0]
