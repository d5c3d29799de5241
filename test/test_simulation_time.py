"""Time of the simulation: an hour at rest, stalls, jumps, and where the robot stands."""

from itertools import pairwise
from math import nan, pi
from signal import SIGCONT, SIGSTOP
from time import sleep

import pytest
from geometry_msgs.msg import PoseWithCovarianceStamped, Twist, WrenchStamped
from nav_msgs.msg import Odometry
from ros_robot import Robot, ros, running, stamps
from std_srvs.srv import Empty, Trigger

from diffbot_sim.nodes.conversions import pose_of, twist_of

HOUR = 3600 * 10**9
HOME = ('-p', 'initial_pose.x:=1.5', '-p', 'initial_pose.yaw:=0.5', '-p', 'frame_prefix:=r/')


@pytest.fixture(scope='module')
def placed(tmp_path_factory):
    """Start a simulator that stands somewhere, and its process."""
    log = tmp_path_factory.mktemp('time') / 'log'
    with Robot('placed') as robot, running(log, *ros('simulator', 'placed', *HOME)) as process:
        robot.hear(1)
        yield robot, process


@pytest.fixture
def robot(placed):
    placed[0].call(Empty, 'simulator/reset', Empty.Request())
    return placed[0].catch_up()


def moved_to(x, y, frame=''):
    message = PoseWithCovarianceStamped()
    message.header.frame_id = frame
    message.pose.pose.position.x, message.pose.pose.position.y = x, y
    message.pose.pose.orientation.z = 1.0  # turned by π
    message.pose.pose.orientation.w = 0.0
    return message


def test_an_hour_at_rest_on_a_slope_changes_no_bit(tmp_path):
    words = ('-p', 'publish_clock:=true', '-p', 'real_time_factor:=0.0')
    words += ('-p', 'publish_rate:=2.0', '-p', 'effects.slope.grade_x:=0.02', *HOME)
    with Robot('hour') as robot, running(tmp_path / 'log', *ros('simulator', 'hour', *words)):
        robot.until(lambda: stamps(robot.heard['odom'][-1:]) > [HOUR])
        told = robot.heard['odom']
    assert {twist_of(message) for message in told} == {(0.0, 0.0)}
    assert len({pose_of(message) for message in told}) == 1
    assert pose_of(told[0]) == pytest.approx((1.5, 0.0, 0.5), abs=1e-15)


def test_the_robot_starts_where_it_is_told_and_returns_there(robot):
    robot.move(12.0, 10.0)
    assert pose_of(robot.hear(1)[0])[0] > 1.5
    robot.call(Empty, 'simulator/reset', Empty.Request())
    assert pose_of(robot.catch_up().hear(1)[0]) == pytest.approx((1.5, 0.0, 0.5), abs=1e-12)


def test_frames_carry_the_prefix(robot):
    (message,) = robot.hear(1)
    assert (message.header.frame_id, message.child_frame_id) == ('r/odom', 'r/base_link')


def test_an_initial_pose_moves_the_robot_and_leaves_it_at_rest(robot):
    robot.move(12.0, 10.0)
    with robot.publishing('initialpose', moved_to(-2.0, 3.0, 'r/odom')):
        robot.until(lambda: pose_of(robot.hear(1)[0]) == pytest.approx((-2.0, 3.0, pi)))
        assert twist_of(robot.hear(1)[0]) == (0.0, 0.0)


@pytest.mark.parametrize(
    ('wrong', 'said'),
    [(moved_to(9.0, 0.0, 'map'), "in 'map'"), (moved_to(nan, 0.0), "in ''")],
)
def test_a_pose_in_another_frame_or_of_nan_is_refused(robot, placed, wrong, said):
    with robot.publishing('initialpose', wrong):
        robot.until(lambda: f'{said} is refused; give a finite pose in' in placed[1].said())
    assert abs(pose_of(robot.hear(1)[0])[0]) < 3.0


def test_a_running_robot_is_not_stepped(robot):
    answer = robot.call(Trigger, 'simulator/step', Trigger.Request())
    assert (answer.success, answer.message) == (False, 'not paused: ~/pause first')


def test_a_stall_loses_no_tick(robot, placed):
    before = stamps(robot.hear(1))[0]
    process = placed[1].process
    process.send_signal(SIGSTOP)
    sleep(0.6)
    process.send_signal(SIGCONT)
    told = stamps(robot.hear(70))
    assert told[0] - before < 10**9
    assert {later - stamp for stamp, later in pairwise(told)} == {10_000_000}


def test_the_inner_loop_goes_on_when_time_jumps_back(tmp_path):
    with Robot('jump') as robot, running(tmp_path / 'log', *ros('pi_controller', 'jump')):
        robot.collect(WrenchStamped, 'left_wheel/force_cmd')
        odometry = Odometry()
        odometry.header.stamp.sec = 1000
        with robot.publishing('odom', odometry):
            robot.until(lambda: robot.heard['left_wheel/force_cmd'])
        odometry.header.stamp.sec = 5
        with robot.publishing('odom', odometry):
            robot.until(lambda: stamps(robot.heard['left_wheel/force_cmd'])[-1] == 5 * 10**9)


def test_a_restarted_node_takes_up_its_work(tmp_path):
    loop, simulator = ros('pi_controller', 'again'), ros('simulator', 'again')
    command = Twist()
    command.linear.x = 0.3

    def drives(robot):
        robot.catch_up()
        robot.until(lambda: twist_of(robot.hear(1)[0])[0] == pytest.approx(0.3, abs=0.03))

    with (
        Robot('again') as robot,
        robot.publishing('cmd_vel', command),
        running(tmp_path / 'loop', *loop) as first,
    ):
        with running(tmp_path / 'simulator', *simulator):
            drives(robot)
        with running(tmp_path / 'simulator', *simulator):  # the first one was killed
            drives(robot)
            first.process.kill()
            robot.until(lambda: twist_of(robot.hear(1)[0])[0] == 0.0)
            with running(tmp_path / 'second', *loop):
                drives(robot)
