"""Simulator and inner loop as processes on the real middleware."""

from contextlib import ExitStack
from itertools import pairwise
from math import nan
from signal import SIGINT, SIGTERM
from time import monotonic, sleep

import numpy as np
import pytest
from geometry_msgs.msg import Twist, TwistStamped, WrenchStamped
from nav_msgs.msg import Odometry
from rcl_interfaces.srv import SetParameters
from rclpy.parameter import Parameter
from ros_robot import PATIENCE, Robot, refusal, running, stamps
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from std_srvs.srv import Empty, SetBool

from diffbot_sim.errors import ConfigError
from diffbot_sim.nodes.conversions import nanoseconds, pose_of, twist_of
from diffbot_sim.nodes.parameters import nested

RADIUS = 0.08
NEAR = 0.03  # m/s and rad/s
STUCK = 2.0  # N; below F_s = 2.4 N of the default robot
LOADED = """
/**:
  ros__parameters:
    robot: {mass: 12, inertia: 0.5}
    effects: {slope: {grade_x: -0.1}}
    odometry_noise: {linear: 0.001, seed: 3}
    real_time_factor: 2
    cmd_vel_timeout: 0
"""


def twist(kind, v, omega):
    message = kind()
    inner = message if kind is Twist else message.twist
    inner.linear.x, inner.angular.z = v, omega
    return message


@pytest.fixture(scope='module')
def started(tmp_path_factory):
    """Start three robots at once: bare, with its inner loop, and with a loaded parameter file."""
    folder = tmp_path_factory.mktemp('nodes')
    (folder / 'loaded.yaml').write_text(LOADED)
    loaded = ('--params-file', str(folder / 'loaded.yaml'))
    robots = {
        'bare': {'simulator': ('-p', 'force_timeout:=0.2')},
        'plain': {'simulator': ('-p', 'publish_clock:=true'), 'pi_controller': ()},
        'loaded': {
            'simulator': loaded,
            'pi_controller': (*loaded, '-p', 'enable_stamped_cmd_vel:=true'),
        },
    }
    with ExitStack() as stack:
        logs = {
            (name, node): stack.enter_context(
                running(
                    folder / f'{name}.{node}.log',
                    *(node, '--ros-args', '-r', f'__ns:=/{name}', *words),
                )
            )
            for name, nodes in robots.items()
            for node, words in nodes.items()
        }
        yield {name: stack.enter_context(Robot(name)) for name in robots}, logs


@pytest.fixture
def robots(started):
    return started[0]


@pytest.fixture
def bare(robots):
    robot = robots['bare']
    robot.call(Empty, 'simulator/reset', Empty.Request())
    return robot.catch_up()


@pytest.fixture
def plain(robots):
    return robots['plain'].catch_up()


@pytest.fixture
def loaded(robots):
    return robots['loaded'].catch_up()


def drive(robot, topic, message, near):
    """Publish a command again and again until the robot moves as wanted."""

    def arrived():
        return twist_of(robot.hear(1)[0]) == pytest.approx(near, abs=NEAR)

    with robot.publishing(topic, message):
        robot.until(arrived)
        robot.until(lambda: all(arrived() for _ in range(10)))


def set_parameter(robot, name, value):
    request = SetParameters.Request(parameters=[Parameter(name, value=value).to_parameter_msg()])
    return robot.call(SetParameters, 'simulator/set_parameters', request).results[0]


def test_odometry_flows_and_its_stamps_are_exactly_one_tick_apart(bare):
    found = stamps(bare.hear(30))
    assert {later - stamp for stamp, later in pairwise(found)} == {10_000_000}


def test_all_messages_of_a_tick_carry_its_stamp(bare):
    topics = [f'{s}_wheel/{n}' for s in ('left', 'right') for n in ('force', 'friction')]
    for topic in topics:
        bare.listen(WrenchStamped, topic)
    bare.listen(JointState, 'joint_states')
    told = [bare.heard[topic] for topic in ('odom', *topics, 'joint_states')]
    # A busy machine may lose some: of five ticks all is heard.
    bare.until(lambda: len(set.intersection(*(set(stamps(each)) for each in told))) >= 5)
    assert bare.heard['left_wheel/force'][0].header.frame_id == 'left_wheel_contact'


def test_a_push_below_stiction_moves_nothing_in_any_bit(bare):
    for message in bare.push(STUCK, -STUCK, 30):
        assert (twist_of(message), pose_of(message)) == ((0.0, 0.0), (0.0, 0.0, 0.0))


def test_a_push_above_stiction_moves_the_robot(bare):
    v, omega = twist_of(bare.move(10.0, 8.0))
    assert v > 0.05
    assert omega > 0.01


def test_a_command_is_dropped_when_it_is_too_old(bare):
    bare.move(10.0, 8.0)
    bare.until(lambda: twist_of(bare.hear(1)[0]) == (0.0, 0.0))


def test_a_command_of_nan_is_refused_and_the_node_lives_on(bare, started):
    assert twist_of(bare.push(nan, 0.0, 10)[-1]) == (0.0, 0.0)
    said = started[1]['bare', 'simulator'].said
    bare.until(lambda: 'force_cmd: nan is not finite, or beyond 1e+06; ignored' in said())
    bare.move(10.0, 8.0)


def test_a_command_beyond_any_robot_is_refused_and_the_node_lives_on(bare):
    assert twist_of(bare.push(1e308, 0.0, 10)[-1]) == (0.0, 0.0)
    bare.move(10.0, 8.0)


def test_reset_puts_the_robot_at_rest_at_the_origin(bare):
    before = stamps([bare.move(10.0, 5.0)])[0]
    bare.call(Empty, 'simulator/reset', Empty.Request())
    bare.until(lambda: pose_of(bare.hear(1)[0]) == (0.0, 0.0, 0.0))
    message = bare.hear(1)[0]
    assert (twist_of(message), pose_of(message)) == ((0.0, 0.0), (0.0, 0.0, 0.0))
    assert stamps([message])[0] > before


def test_pause_stops_time_and_resuming_continues_it(bare):
    assert bare.call(SetBool, 'simulator/pause', SetBool.Request(data=True)).success
    sleep(0.5)
    last = stamps(bare.catch_up().heard['odom'])[-1]
    with pytest.raises(AssertionError, match='did not happen'):
        bare.until(lambda: stamps(bare.heard['odom'])[-1] > last, patience=0.5)
    bare.call(SetBool, 'simulator/pause', SetBool.Request(data=False))
    assert stamps(bare.hear(1))[0] == last + 10_000_000


def test_a_robot_becomes_heavier_while_it_drives(bare):
    bare.move(10.0, 8.0)
    assert set_parameter(bare, 'robot.mass', 1000).successful  # an integer will do
    first, *_, last = bare.push(10.0, 10.0, 10)
    assert set_parameter(bare, 'robot.mass', 10.0).successful
    before, after = stamps([first, last])
    gained = twist_of(last)[0] - twist_of(first)[0]
    assert abs(gained) <= 20.0 / 1000.0 * (after - before) / 1e9
    assert twist_of(last)[0] > 0.0


def test_time_may_all_but_stand_still_and_goes_on(bare):
    assert set_parameter(bare, 'real_time_factor', 1e-12).successful
    assert set_parameter(bare, 'real_time_factor', 1.0).successful
    first, *_, last = stamps(bare.hear(10))
    assert last > first


def test_effort_is_that_of_the_force_that_the_motors_give(bare):
    bare.listen(JointState, 'joint_states')
    assert set_parameter(bare, 'effects.actuator_saturation.limit', 3.0).successful
    bare.push(10.0, 8.0, 20)
    last = list(bare.heard['joint_states'][-1].effort)
    assert last == pytest.approx([3.0 * RADIUS, 3.0 * RADIUS])
    assert set_parameter(bare, 'effects.actuator_saturation.limit', 1e6).successful


@pytest.mark.parametrize('last', ['robot.mass', 'robot.mass.kg'])
def test_name_that_is_a_value_and_a_section_is_refused(last):
    values = {'robot.mass': 10.0, 'robot.mass.kg': 12.0}
    last_value = values.pop(last)
    with pytest.raises(ConfigError, match="kg: 'mass' is a value already"):
        nested({**values, last: last_value})


@pytest.mark.parametrize(
    ('name', 'strong', 'usual'),
    [('effects.quadratic_drag.coefficient', 500.0, 0.0), ('friction.mu_viscous', 2.0, 0.08)],
)
def test_what_holds_a_robot_back_changes_while_it_drives(bare, name, strong, usual):
    assert set_parameter(bare, name, strong).successful
    assert twist_of(bare.push(10.0, 10.0, 100)[-1])[0] < 0.25  # 1.5 m/s without it
    assert set_parameter(bare, name, usual).successful


@pytest.mark.parametrize(
    ('name', 'value', 'reason'),
    [
        ('friction.mu_coulomb', 0.5, 'exceeds friction.mu_static'),
        ('friction.model', 'sandy', 'takes one of none, coulomb'),
        ('robot.mass', -1.0, 'out of range'),
        ('robot.mass', nan, 'out of range'),
        ('publish_rate', 50.0, 'read-only'),
        ('effects.slope.grade', 0.1, "Did you mean 'effects.slope.grade_"),
    ],
)
def test_a_wrong_parameter_is_refused_with_a_reason(bare, name, value, reason):
    result = set_parameter(bare, name, value)
    assert not result.successful
    assert reason in result.reason
    bare.hear(1)


@pytest.mark.parametrize(
    ('argument', 'message'),
    [
        ('effects.quadratic_drg.coefficient:=1.0', "Did you mean 'quadratic_drag'?"),
        ('effects.slope.grade:=1.0', "Known: grade_x, grade_y. Did you mean 'grade_"),
        ('publish_rat:=1.0', "Did you mean 'publish_rate'?"),
        ('robot.mass:=-1.0', 'takes 0.001 to 100000 kg'),
        ('friction.mu_coulomb:=1.0', 'exceeds friction.mu_static'),
        ('use_sim_time:=1', "expecting type 'BOOL'"),
    ],
)
def test_a_wrong_parameter_at_the_start_is_told_in_one_line(argument, message):
    assert message in refusal('simulator', '--ros-args', '-p', argument)


def test_a_parameter_file_that_is_missing_is_told_in_one_line():
    line = refusal('pi_controller', '--ros-args', '--params-file', '/nowhere.yaml')
    assert "'--params-file /nowhere.yaml'. Error: Error opening YAML file" in line


@pytest.mark.parametrize('number', [SIGINT, SIGTERM])
def test_a_node_that_hears_nothing_ends_at_once_when_told(number, tmp_path):
    words = ('--ros-args', '-r', '__ns:=/idle')
    with running(tmp_path / 'log', 'pi_controller', *words) as idle:
        while 'ready' not in idle.said():
            assert idle.process.poll() is None
            sleep(0.05)
        told = monotonic()
        assert idle.stop(number) == 0
    assert monotonic() - told < PATIENCE / 10
    assert 'Traceback' not in idle.said()


def test_simulation_time_starts_at_zero_and_is_published(plain):
    plain.listen(Clock, '/clock')
    told, odom = plain.heard['/clock'], plain.heard['odom']
    plain.until(lambda: {nanoseconds(m.clock) for m in told} & set(stamps(odom)))
    assert stamps(odom)[0] < 3600 * 10**9


def test_the_inner_loop_reaches_a_twist_and_stops_when_commands_cease(plain):
    drive(plain, 'cmd_vel', twist(Twist, 0.4, 0.5), near=(0.4, 0.5))
    plain.until(lambda: twist_of(plain.hear(1)[0]) == (0.0, 0.0))


@pytest.mark.parametrize('speed', [nan, 1e308])
def test_the_inner_loop_refuses_what_nobody_can_mean_and_lives_on(plain, started, speed):
    said = started[1]['plain', 'pi_controller'].said
    with plain.publishing('cmd_vel', twist(Twist, speed, 0.0)):
        plain.until(lambda: f'cmd_vel: {speed}, 0.0 is not finite' in said())
    drive(plain, 'cmd_vel', twist(Twist, 0.2, 0.0), near=(0.2, 0.0))


def test_a_single_wheel_follows_its_own_reference(plain):
    message = TwistStamped()
    message.twist.angular.y = 5.0
    v = 5.0 * RADIUS / 2.0
    drive(plain, 'right_wheel/velocity_cmd', message, near=(v, v / 0.2))


def test_a_parameter_file_loads_robot_effects_and_noise(loaded, started):
    assert '100 Hz, slope' in started[1]['loaded', 'simulator'].said()
    assert len({twist_of(message)[0] for message in loaded.hear(10)}) == 10


def test_the_inner_loop_holds_a_stamped_twist_on_a_slope_at_double_speed(loaded):
    drive(loaded, 'cmd_vel', twist(TwistStamped, 0.3, 0.0), near=(0.3, 0.0))
    held = loaded.hear(300)[-100:]  # 3 s without a command, and no time-out
    # A machine that halts the loop for a moment lets the slope have the robot: hence the median.
    assert np.median([twist_of(m) for m in held], axis=0) == pytest.approx((0.3, 0.0), abs=NEAR)


def test_a_twist_of_the_other_type_is_told(plain, started):
    said = started[1]['plain', 'pi_controller'].said
    with plain.publishing('cmd_vel', twist(TwistStamped, 0.2, 0.0)):
        plain.until(lambda: 'start it with enable_stamped_cmd_vel:=true' in said())


def test_another_robot_on_the_same_odometry_is_told(loaded, started):
    said = started[1]['loaded', 'simulator'].said
    with loaded.publishing('odom', Odometry()):
        loaded.until(lambda: '/odom: 1 other publisher; is another simulator running?' in said())
