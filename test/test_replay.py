"""`replay` as a process: where it starts, its clock, its keys."""

import os
import pty
import subprocess
import termios
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from signal import SIGINT
from time import monotonic
from typing import Any

import numpy as np
import pytest
from drives import START, drive
from geometry_msgs.msg import WrenchStamped
from nav_msgs.msg import Odometry
from rclpy.qos import DurabilityPolicy, QoSProfile
from ros_robot import COMMAND, DEPTH, PATIENCE, Robot, refusal, running
from rosgraph_msgs.msg import Clock

from diffbot_sim.bags import write_run
from diffbot_sim.bags.raw import Offer, raw_messages
from diffbot_sim.bags.recording import RawWriter
from diffbot_sim.nodes.conversions import nanoseconds
from diffbot_sim.nodes.targets import commands

ODOM = ('--topics', 'odom')


@pytest.fixture(scope='module')
def robot():
    with Robot() as robot:
        yield robot


@pytest.fixture(scope='module')
def bag(tmp_path_factory) -> Path:
    """Return 1 s of a drive: a hundred messages of each topic."""
    folder = tmp_path_factory.mktemp('replay') / 'drive'
    write_run(folder, drive(), START)
    return folder


def replayed(robot: Robot, log: Path, *words: str) -> list[float]:
    """Replay to the end; return the recorded times [s] of the odometry that was heard."""
    robot.catch_up().heard['odom'].clear()
    with running(log, 'replay', *words, *ODOM) as replay:
        robot.until(lambda: replay.process.poll() is not None)
    assert replay.process.returncode == 0
    heard = robot.catch_up().heard['odom']
    return [(nanoseconds(message.header.stamp) - START) / 1e9 for message in heard]


def test_replay_starts_where_it_is_told(bag, robot, tmp_path):
    times = replayed(robot, tmp_path / 'log', str(bag), '--start-offset', '0.6')
    np.testing.assert_allclose(times, np.arange(60, 100) / 100.0)


def test_a_start_beyond_the_end_is_refused(bag):
    line = refusal('replay', str(bag), '--start-offset', '2')
    assert 'lasts 1.0 s; choose a --start-offset below that' in line


@pytest.mark.parametrize('words', [[], ['--loop']])
def test_a_start_after_the_last_message_of_what_is_replayed_is_refused(tmp_path, words):
    run, long = drive(), np.linspace(0.0, 5.0, 100)
    write_run(tmp_path / 'bag', replace(run, odometry=replace(run.odometry, time=long)), START)
    line = refusal('replay', str(tmp_path / 'bag'), '--start-offset', '3', *words)
    assert 'nothing on /left_wheel/force, /right_wheel/force after 3 s; choose a smaller' in line


def test_each_wheel_is_replayed_by_the_better_of_its_topics():
    wheels = ('/a/left_wheel/force', '/a/left_wheel/force_cmd', '/a/right_wheel/force_cmd')
    there = [*wheels, '/right_wheel/force', '/a/odom']
    assert commands(there, Path('bag')) == {
        '/right_wheel/force': 'right_wheel/force_cmd',
        '/a/left_wheel/force': 'a/left_wheel/force_cmd',
        '/a/right_wheel/force_cmd': 'a/right_wheel/force_cmd',
    }


@pytest.mark.parametrize('words', [['--start-offset', '-1'], ['--clock', '0'], ['--rate', 'x']])
def test_numbers_out_of_range_are_wrong_usage(bag, words):
    done = subprocess.run([*COMMAND, 'replay', str(bag), *words], capture_output=True, check=False)
    assert done.returncode == 2
    assert b'is not a number' in done.stderr


def test_the_clock_tells_the_recorded_time_and_jumps_back_with_the_loop(bag, robot, tmp_path):
    words = (str(bag), *ODOM, '--loop', '--rate', '0.5', '--clock', '100')
    with running(tmp_path / 'log', 'replay', *words) as replay:
        robot.listen(Clock, '/clock')
        ticks = robot.heard['/clock']
        robot.until(lambda: len(ticks) > 500)
        assert replay.stop(SIGINT) == 0
    times = np.array([nanoseconds(tick.clock) - START for tick in ticks]) / 1e9
    steps = np.diff(times)
    assert -0.01 <= times.min() <= times.max() < 1.1
    assert np.count_nonzero(steps < 0.0) in (2, 3)
    assert steps[steps > 0.0].mean() == pytest.approx(0.005, rel=0.3)


def test_what_was_kept_for_late_listeners_is_kept_again(bag, robot, tmp_path):
    kept = tmp_path / 'kept'
    writer = RawWriter(kept)
    for message in raw_messages(bag, {'/odom'}):
        writer.write(message, Offer(durability='transient_local'))
    writer.close()
    robot.catch_up().heard['odom'].clear()
    with running(tmp_path / 'log', 'replay', str(kept), *ODOM, '--rate', '0.2'):
        robot.until(lambda: len(robot.heard['odom']) > 20)
        late: list[Odometry] = []
        quality = QoSProfile(depth=DEPTH, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        robot.node.create_subscription(Odometry, 'odom', late.append, quality)
        robot.until(lambda: late)
    assert nanoseconds(late[0].header.stamp) == START


class Terminal:
    """A replay at a terminal of its own."""

    def __init__(self, *words: str) -> None:
        self.keyboard, self.slave = pty.openpty()
        self.before = termios.tcgetattr(self.slave)
        self.process = subprocess.Popen(
            ['setsid', '--ctty', *COMMAND, 'replay', *words],  # so that Ctrl-C is a signal
            stdin=self.slave,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )

    def press(self, key: str) -> None:
        os.write(self.keyboard, key.encode())

    def end(self) -> None:
        self.process.kill()
        self.process.wait()
        os.close(self.keyboard)
        os.close(self.slave)


@contextmanager
def terminal(robot: Robot, *words: str) -> Iterator[Terminal]:
    """Replay at a terminal until the end of the block; return when keys are read."""
    robot.catch_up()
    shown = Terminal(*words)
    try:
        robot.until(lambda: termios.tcgetattr(shown.slave) != shown.before)
        yield shown
    finally:
        shown.end()


def settled(robot: Robot, told: Callable[[], Any]) -> Any:
    """Wait until what is told has stayed the same for a second; return it."""
    for _ in range(30):
        before, end = told(), monotonic() + 1.0
        robot.until(lambda end=end: monotonic() > end)
        if told() == before:
            return before
    raise AssertionError('it never stands still')


def played_by_a_dot(robot: Robot, replay: Terminal) -> int:
    """Press the dot while paused; return how many messages come."""

    def heard() -> int:
        return sum(map(len, robot.heard.values()))

    before = settled(robot, heard)
    replay.press('.')
    robot.until(lambda: heard() > before)
    return int(settled(robot, heard) - before)


def test_the_space_bar_pauses_and_resumes(bag, robot):
    with terminal(robot, str(bag), *ODOM, '--loop', '--rate', '0.2') as replay:
        robot.hear(5)
        replay.press(' ')
        assert played_by_a_dot(robot, replay) == 1
        replay.press(' ')
        assert len(robot.hear(5)) == 5


def test_a_dot_at_the_end_plays_the_first_message_by_itself(bag, robot):
    words = ('--start-offset', '0.98', '--loop', '--rate', '0.001')  # two messages, 10 s apart
    with terminal(robot, str(bag), *ODOM, *words) as replay:
        replay.press(' ')
        assert [played_by_a_dot(robot, replay) for _ in range(3)] == [1, 1, 1]


def test_a_dot_plays_one_of_two_messages_with_the_same_stamp(bag, robot):
    for side in ('left', 'right'):
        robot.collect(WrenchStamped, f'{side}_wheel/force_cmd')
    with terminal(robot, str(bag), '--rate', '0.001') as replay:
        replay.press(' ')
        assert [played_by_a_dot(robot, replay) for _ in range(3)] == [1, 1, 1]


def test_the_clock_stands_still_while_paused(bag, robot):
    with terminal(robot, str(bag), *ODOM, '--loop', '--rate', '0.2', '--clock') as replay:
        robot.listen(Clock, '/clock')
        ticks = robot.heard['/clock']
        replay.press(' ')
        settled(robot, lambda: ticks[-1].clock)
        before = len(ticks)
        robot.until(lambda: len(ticks) > before + 10)
    assert len({nanoseconds(tick.clock) for tick in ticks[before:]}) == 1


@pytest.mark.parametrize('how', ['the end', 'Ctrl-C'])
def test_the_terminal_is_put_back(bag, robot, how):
    words = ('--rate', '0.2') if how == 'Ctrl-C' else ()
    with terminal(robot, str(bag), *ODOM, *words) as replay:
        if how == 'Ctrl-C':
            replay.press('\x03')
        assert replay.process.wait(PATIENCE) == 0
        assert termios.tcgetattr(replay.slave) == replay.before
