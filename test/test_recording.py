"""Recorder and replay as processes: what was driven comes back."""

from collections.abc import Iterator
from contextlib import contextmanager
from itertools import groupby
from pathlib import Path
from signal import SIGCONT, SIGINT, SIGKILL, SIGSTOP, SIGTERM
from time import time_ns

import numpy as np
import pytest
from builtin_interfaces.msg import Time
from geometry_msgs.msg import WrenchStamped
from nav_msgs.msg import Odometry
from ros_robot import Robot, Running, refusal, running
from rosbags.rosbag2 import Reader
from rosgraph_msgs.msg import Clock
from std_srvs.srv import Empty

from diffbot_sim.bags import read_run
from diffbot_sim.bags.raw import Raw
from diffbot_sim.bags.recording import RawWriter
from diffbot_sim.bags.recover import recover
from diffbot_sim.errors import BagError
from diffbot_sim.nodes.conversions import pose_of, twist_of
from diffbot_sim.physics import Model, simulate

WHEELS = [f'{s}_wheel/{n}' for s in ('left', 'right') for n in ('force', 'friction')]
SPOKEN = ['odom', 'joint_states', *WHEELS]  # by the simulator
PUSHES = ((12.0, 11.0, 40), (0.0, 0.0, 160))
COUNT = sum(count for *_, count in PUSHES)


@pytest.fixture(scope='module')
def robot():
    with Robot() as robot:
        yield robot


@pytest.fixture(scope='module')
def simulator(tmp_path_factory, robot):
    with running(tmp_path_factory.mktemp('sim') / 'log', 'simulator') as process:
        robot.hear(1)
        yield process


@contextmanager
def recording(robot: Robot, folder: Path, *words: str) -> Iterator[Running]:
    """Record to folder/bag; the block begins when every topic is heard, which may take seconds."""
    output = ('--output', str(folder / 'bag'))
    with running(folder / 'log', 'recorder', *output, *words) as recorder:
        robot.until(lambda: all(f'hears {topic}\n' in recorder.said() for topic in SPOKEN))
        yield recorder


@pytest.fixture(scope='module')
def bag(tmp_path_factory, robot, simulator):
    """Record a drive of pushes and a stop; end the recording with SIGTERM."""
    folder = tmp_path_factory.mktemp('recorder')
    with recording(robot, folder) as recorder:
        robot.until(lambda: robot.listeners() > 1)
        robot.hear(20)  # who has just begun to record is late, and its spacing of the bag wrong
        for push in PUSHES:
            robot.push(*push)
        robot.hear(20)  # messages on their way when the signal comes are lost
        assert recorder.stop(SIGTERM) == 0
    assert 'Traceback' not in recorder.said()
    return folder / 'bag'


def recorded(bag: Path) -> dict[str, int]:
    with Reader(bag) as reader:
        return {item.topic: item.msgcount for item in reader.connections}


def test_a_recording_holds_every_message_of_every_topic(bag):
    counts = recorded(bag)
    assert min(counts[f'/{topic}'] for topic in SPOKEN) >= COUNT
    sent = [counts[f'/{side}_wheel/force_cmd'] for side in ('left', 'right')]
    assert min(sent) >= COUNT - 2  # one may be on its way when the signal comes


def test_the_quality_of_service_is_recorded(bag):
    with Reader(bag) as reader:
        (quality,) = reader.connections[0].ext.offered_qos_profiles
    assert (quality.reliability.name, quality.durability.name) == ('RELIABLE', 'VOLATILE')


def test_the_model_driven_with_the_recorded_forces_repeats_the_recorded_motion(bag):
    run = read_run(bag).run
    odom = run.odometry
    predicted = simulate(Model(), run.commands, odom.time, max_step=1e-3)
    np.testing.assert_allclose(predicted.twist, odom.twist, atol=1e-6)
    np.testing.assert_allclose(predicted.pose, odom.pose, atol=1e-6)
    assert np.abs(odom.twist).max() > 0.2


def test_a_recorder_says_what_it_found_before_anyone_speaks(robot, tmp_path):
    topic = 'left_wheel/force_cmd'
    with running(tmp_path / 'log', 'recorder', '-o', str(tmp_path / 'bag')) as recorder:
        robot.until(lambda: f'found {topic}\n' in recorder.said())
        assert f'hears {topic}' not in recorder.said()


def test_replaying_a_bag_pushes_the_robot_as_recorded(bag, robot, simulator, tmp_path):
    robot.listen(WrenchStamped, 'right_wheel/force')
    robot.call(Empty, 'simulator/reset', Empty.Request())
    with running(tmp_path / 'log', 'replay', str(bag)) as replay:
        robot.until(lambda: replay.process.poll() is not None)
    assert replay.process.returncode == 0
    end = robot.catch_up().hear(1)[0]
    forces = [message.wrench.force.x for message in robot.heard['right_wheel/force']]
    # How long each force acts, and so where the robot ends, a busy machine changes.
    assert [force for force, _ in groupby(forces)] == [0.0, 12.0, 0.0]
    assert twist_of(end) == (0.0, 0.0)
    assert pose_of(end)[0] > 0.1


def test_any_topic_replays_faster_into_another_namespace(bag, robot, tmp_path):
    words = ('--topics', 'odom', '--rate', '4', '--ros-args', '-r', '__ns:=/other')
    with Robot('/other') as other:
        with running(tmp_path / 'log', 'replay', str(bag), *words) as replay:
            other.until(lambda: replay.process.poll() is not None)
        assert len(other.catch_up().heard['odom']) == recorded(bag)['/odom']


def test_a_running_replay_ends_quietly_on_ctrl_c(bag, robot, simulator, tmp_path):
    with running(tmp_path / 'log', 'replay', str(bag), '--loop', '--rate', '0.1') as replay:
        robot.until(lambda: 'replaying' in replay.said())
        assert replay.stop(SIGINT) == 0
    assert 'Traceback' not in replay.said()


def test_a_recorder_refuses_a_folder_that_exists(tmp_path):
    assert 'exists already' in refusal('recorder', '--output', str(tmp_path))


def test_a_recorder_refuses_what_is_no_name_of_a_topic(tmp_path):
    said = refusal('recorder', '-o', str(tmp_path / 'bag'), '--topics', 'bad topic!')
    assert "topics: 'bad topic!' is no name of a topic" in said


def test_replay_says_what_is_wrong_with_a_bag(bag, tmp_path):
    assert 'there is no such bag' in refusal('replay', str(tmp_path / 'none'))
    assert 'The bag holds /joint_states' in refusal('replay', str(bag), '--topics', 'image')


def test_a_recording_in_parts_is_one_bag(robot, simulator, tmp_path):
    def parts() -> int:
        return len(list((tmp_path / 'bag').glob('bag_*.db3')))

    with recording(robot, tmp_path, '-s', 'sqlite3', '-d', '1') as recorder:
        enough = parts() + 2
        robot.until(lambda: parts() >= enough)
        robot.hear(30)  # something of the next
        assert recorder.stop(SIGTERM) == 0
    assert parts() > enough
    odom = read_run(tmp_path / 'bag').run.odometry
    assert odom.time[-1] > 2.0
    assert np.diff(odom.time).max() < 0.1


@pytest.mark.parametrize('storage', ['mcap', 'sqlite3'])
def test_a_killed_recorder_loses_a_second_at_most(robot, simulator, tmp_path, storage):
    with recording(robot, tmp_path, '--storage', storage) as recorder:
        robot.hear(350)
        recorder.stop(SIGKILL)
        killed = time_ns()
    saved = recover(tmp_path / 'bag', tmp_path / 'whole').saved['/odom']
    assert killed - saved.last < 2e9
    assert saved.count > 150


def test_a_recorder_that_gets_no_time_loses_no_message(robot, simulator, tmp_path):
    with recording(robot, tmp_path) as recorder:
        robot.hear(150)
        recorder.process.send_signal(SIGSTOP)
        robot.hear(50)  # half a second: shared memory forgets who is frozen for a whole one
        recorder.process.send_signal(SIGCONT)
        robot.hear(200)
        assert recorder.stop() == 0
    run = read_run(tmp_path / 'bag').run
    assert len(run.odometry.time) > 300
    for time in (run.odometry.time, run.commands.time):
        np.testing.assert_allclose(np.diff(time), 0.01, atol=1e-6)


@contextmanager
def recording_simulated(folder: Path) -> Iterator[tuple[Robot, Running]]:
    """Record odometry to folder/bag by a clock that nobody has published yet."""
    words = ('--ros-args', '-r', '__ns:=/simulated', '-p', 'use_sim_time:=true')
    chosen = ('-o', str(folder / 'bag'), '--topics', 'odom')
    with (
        Robot('/simulated') as robot,
        running(folder / 'log', 'recorder', *chosen, *words) as node,
        robot.publishing('odom', Odometry()),
    ):
        robot.until(lambda: 'waits for /clock' in node.said())
        yield robot, node


def test_what_comes_before_simulation_time_begins_is_recorded_as_it_begins(tmp_path):
    with recording_simulated(tmp_path) as (robot, recorder):
        with robot.publishing('/clock', Clock(clock=Time(sec=5))):
            robot.hear(40)
        assert recorder.stop() == 0
    with Reader(tmp_path / 'bag') as reader:
        received = [stamp for _, stamp, _ in reader.messages()]
    assert len(received) > 1
    assert set(received) == {5_000_000_000}


def test_without_a_clock_messages_are_recorded_as_they_were_received(tmp_path):
    begin = time_ns()
    with recording_simulated(tmp_path) as (_, recorder):
        assert recorder.stop() == 0
    assert 'no /clock came' in recorder.said()
    with Reader(tmp_path / 'bag') as reader:
        assert all(begin < stamp < time_ns() for _, stamp, _ in reader.messages())
        assert reader.message_count > 0


def test_an_unfinished_bag_is_told(tmp_path):
    writer = RawWriter(tmp_path / 'bag')
    writer.write(Raw(1, '/odom', 'nav_msgs/msg/Odometry', bytes(8)))
    assert 'cut off' in refusal('replay', str(tmp_path / 'bag'))
    with pytest.raises(BagError, match='exists already'):
        RawWriter(tmp_path / 'bag')


@pytest.mark.parametrize('node', ['simulator', 'pi_controller', 'recorder', 'replay'])
def test_help_is_there_without_ros(node, tmp_path):
    with running(tmp_path / 'log', node, '--help') as helped:
        assert helped.process.wait(30.0) == 0
    assert 'usage' in helped.said()


def test_the_simulator_ends_quietly_on_ctrl_c(simulator):
    assert simulator.stop(SIGINT) == 0
    assert 'Traceback' not in simulator.said()
