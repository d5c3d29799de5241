"""In lockstep a closed loop through ROS repeats to the bit, however busy the machine is."""

from math import nan

import pytest
from geometry_msgs.msg import WrenchStamped
from ros_robot import Robot, refusal, ros, running
from std_srvs.srv import Empty, SetBool, Trigger

from diffbot_sim.nodes.conversions import nanoseconds, twist_of

TICK = 10_000_000
SIMULATOR = ('-p', 'lockstep:=true', '-p', 'odometry_noise.linear:=0.01')
LOOP = ('-p', 'lockstep:=true', '-p', 'enable_stamped_cmd_vel:=true')
DRIVER = ('-p', 'stamped:=true', '-p', 'duration:=5.0')


def stamp_of(message):
    return nanoseconds(message.header.stamp)


def odometry_of_a_drive(folder, namespace):
    """Run simulator, inner loop and driver to the end of the drive; return what came by stamp."""
    with (
        Robot(namespace) as robot,
        running(folder / f'{namespace}.simulator', *ros('simulator', namespace, *SIMULATOR)),
        running(folder / f'{namespace}.loop', *ros('pi_controller', namespace, *LOOP)),
    ):
        robot.hear(1)  # again and again the first, for without the driver nothing is answered
        with running(folder / f'{namespace}.driver', *ros('driver', namespace, *DRIVER)) as driver:
            robot.until(lambda: driver.process.poll() is not None)
        robot.until(lambda: stamp_of(robot.heard['odom'][-1]) >= 500 * TICK)
        return {stamp_of(message): message for message in robot.heard['odom']}


@pytest.fixture(scope='module')
def alone(tmp_path_factory):
    """Start a simulator that waits for this test's commands."""
    log = tmp_path_factory.mktemp('lockstep') / 'log'
    words = ros('simulator', 'alone', '-p', 'lockstep:=true')
    with Robot('alone') as robot, running(log, *words):
        robot.until(robot.listeners)
        yield robot


def answer(robot, side, force, stamp=0):
    message = WrenchStamped()
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(stamp, 10**9)
    message.wrench.force.x = force
    robot.publish_force(side, message)


def latest(robot):
    return stamp_of(robot.hear(1)[0])


def test_two_closed_loops_give_the_same_odometry_to_the_bit(tmp_path):
    first, second = (odometry_of_a_drive(tmp_path, name) for name in ('first', 'second'))
    whole = range(TICK, 501 * TICK, TICK)  # what comes after the drive depends on who ends first
    assert list(first)[:500] == list(second)[:500] == list(whole)
    assert [first[stamp] for stamp in whole] == [second[stamp] for stamp in whole]


def test_time_stands_still_until_both_wheels_have_been_commanded(alone):
    now = latest(alone)
    answer(alone, 'left', 5.0)
    assert latest(alone) == now  # told again, since nobody answers
    answer(alone, 'right', 5.0)
    alone.until(lambda: stamp_of(alone.heard['odom'][-1]) == now + TICK)


def test_an_answer_to_an_earlier_tick_does_not_count(alone):
    now = latest(alone)
    for side in ('left', 'right'):
        answer(alone, side, 5.0, stamp=now - TICK)
    assert [stamp_of(message) for message in alone.hear(2)] == [now, now]


def test_what_is_no_force_is_no_answer(alone):
    now = latest(alone)
    for side in ('left', 'right'):
        answer(alone, side, nan)
    assert latest(alone) == now


def test_a_paused_robot_makes_a_single_step_when_told(alone):
    now = latest(alone)
    alone.call(SetBool, 'simulator/pause', SetBool.Request(data=True))
    for side in ('left', 'right'):
        answer(alone, side, 12.0)
    assert alone.call(Trigger, 'simulator/step', Trigger.Request()).success
    message = alone.hear(1)[-1]
    assert stamp_of(message) == now + TICK
    assert twist_of(message)[0] > 0.0
    for side in ('left', 'right'):
        answer(alone, side, 12.0)
    with pytest.raises(AssertionError, match='did not happen'):
        alone.until(lambda: stamp_of(alone.heard['odom'][-1]) > now + TICK, patience=1.5)
    alone.call(SetBool, 'simulator/pause', SetBool.Request(data=False))


def test_a_loop_in_lockstep_needs_stamped_twists():
    line = refusal('pi_controller', '--ros-args', '-p', 'lockstep:=true')
    assert 'Set enable_stamped_cmd_vel to true' in line


def test_reset_waits_for_both_wheels_anew_and_takes_no_answer_to_what_was_before(alone):
    before = latest(alone)
    answer(alone, 'left', 5.0, stamp=before)
    alone.call(Empty, 'simulator/reset', Empty.Request())
    answer(alone, 'right', 5.0, stamp=before)
    alone.until(lambda: stamp_of(alone.heard['odom'][-1]) == before + TICK)
    assert latest(alone) == before + TICK
