"""Launch files, as `ros2 launch` starts them in a workspace."""

import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from os import kill
from pathlib import Path
from shutil import which
from signal import SIGINT, SIGKILL

import pytest
from geometry_msgs.msg import Twist, Vector3
from ros_robot import PATIENCE, Robot, Running, start

from diffbot_sim.bags import read_run


def is_installed() -> bool:
    """Say whether ros2 launch is there and finds this package."""
    if which('ros2') is None:
        return False
    asked = ['ros2', 'pkg', 'prefix', 'diffbot_sim']
    return subprocess.run(asked, capture_output=True, check=False).returncode == 0


pytestmark = pytest.mark.skipif(
    not is_installed(),
    reason='no ros2 launch: build and source the package in a ROS 2 workspace, see docs/ros.md',
)
FORWARD = Twist(linear=Vector3(x=0.4))
RECORDED = ['right_wheel/force', 'left_wheel/force', 'odom']


@contextmanager
def launched(log: Path, *words: str) -> Iterator[Running]:
    """Launch until the end of the block; what was launched ends with it."""
    started = start(log, 'ros2', 'launch', 'diffbot_sim', *words)
    try:
        yield started
    finally:
        started.stop(SIGINT)


def part_of(launch: Running, name: str) -> int:
    """Return the process number of a node that a launch has started."""
    number = launch.process.pid
    children = Path(f'/proc/{number}/task/{number}/children').read_text().split()
    (found,) = [c for c in children if name in Path(f'/proc/{c}/cmdline').read_text()]
    return int(found)


def test_bringup_drives_as_told_and_leaves_a_bag(tmp_path: Path) -> None:
    bag, words = tmp_path / 'bag', ['bringup_launch.py', 'namespace:=driven', 'record:=true']
    with launched(tmp_path / 'log', *words, f'output:={bag}') as launch, Robot('driven') as robot:
        robot.until(lambda: all(f'hears {topic}' in launch.said() for topic in RECORDED))
        with robot.publishing('cmd_vel', FORWARD):
            robot.until(lambda: robot.hear(100)[-1].twist.twist.linear.x > 0.35)
        assert launch.stop(SIGINT) == 0
    assert read_run(bag).run.odometry.twist[:, 0].max() > 0.3


def test_two_robots_drive_apart(tmp_path: Path) -> None:
    with (
        launched(tmp_path / 'log', 'two_robots_launch.py'),
        Robot('robot1') as one,
        Robot('robot2') as other,
        one.publishing('cmd_vel', FORWARD),
    ):
        one.until(lambda: one.hear(1)[0].twist.twist.linear.x > 0.3)
        assert other.hear(1)[0].twist.twist.linear.x == 0.0


def test_robot_that_loses_its_controller_ends_with_an_error(tmp_path: Path) -> None:
    words = ['bringup_launch.py', 'namespace:=bereft']
    with launched(tmp_path / 'log', *words) as launch, Robot('bereft') as robot:
        robot.hear(1)
        left = Path(f'/proc/{part_of(launch, "simulator")}')
        kill(part_of(launch, 'pi_controller'), SIGKILL)
        assert launch.process.wait(PATIENCE) == 1
        assert not left.exists()


def test_parameter_file_that_is_not_there_is_named(tmp_path: Path) -> None:
    with launched(tmp_path / 'log', 'bringup_launch.py', 'params:=nowhere.yaml') as launch:
        assert launch.process.wait(PATIENCE) == 1
    assert 'nowhere.yaml' in launch.said()
