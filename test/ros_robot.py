"""Helpers for tests that talk to nodes in processes of their own."""

import subprocess
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from signal import SIGTERM
from time import monotonic
from typing import Any, NamedTuple

import rclpy
from geometry_msgs.msg import WrenchStamped
from nav_msgs.msg import Odometry
from rclpy.node import Node

from diffbot_sim.__main__ import COMPILES
from diffbot_sim.nodes.conversions import nanoseconds, twist_of

COMMAND = [sys.executable, '-m', 'diffbot_sim']
DEPTH = 1000  # messages that may wait while a test is busy
PATIENCE = 120.0  # seconds; a first start compiles, and others may be compiling too


class Running(NamedTuple):
    """A node's process and the file that holds what it said."""

    process: subprocess.Popen[bytes]
    log: Path

    def stop(self, number: int = SIGTERM) -> int:
        """Send a signal and return the exit code."""
        self.process.send_signal(number)
        return self.process.wait(PATIENCE)

    def said(self) -> str:
        return self.log.read_text()


def start(log: Path, *command: str) -> Running:
    """Start a process."""
    with log.open('wb') as file:
        return Running(subprocess.Popen(command, stdout=file, stderr=subprocess.STDOUT), log)


@contextmanager
def running(log: Path, *words: str) -> Iterator[Running]:
    """Run a command until the end of the block."""
    started = start(log, *COMMAND, *words)
    try:
        yield started
    finally:
        started.process.kill()
        started.process.wait()


def refusal(*words: str) -> str:
    """Run a command that must end with exit code 1 and one line; return the line."""
    result = subprocess.run(
        [*COMMAND, *words], capture_output=True, text=True, timeout=PATIENCE, check=False
    )
    assert result.returncode == 1
    # Where a machine is slow the command says first that it is loading.
    (line,) = (line for line in result.stderr.splitlines() if line != COMPILES)
    return line


def stamps(messages: Iterable[Any]) -> list[int]:
    """Return the header stamps [ns] of messages."""
    return [nanoseconds(message.header.stamp) for message in messages]


def ros(node: str, namespace: str, *words: str) -> tuple[str, ...]:
    """Return the words that start a node in a namespace."""
    return (node, '--ros-args', '-r', f'__ns:=/{namespace}', *words)


class Robot:
    """Listens to one robot and drives it, from the test's own process."""

    def __init__(self, namespace: str = '/') -> None:
        if not rclpy.ok():
            rclpy.init()  # for the whole session: what outlives its context crashes
        self.node = Node('tester', namespace=namespace, start_parameter_services=False)
        self.heard: dict[str, list[Any]] = {'odom': []}
        self.node.create_subscription(Odometry, 'odom', self.heard['odom'].append, DEPTH)
        self._forces = {
            side: self.node.create_publisher(WrenchStamped, f'{side}_wheel/force_cmd', DEPTH)
            for side in ('left', 'right')
        }

    def __enter__(self) -> 'Robot':
        return self

    def __exit__(self, *_: object) -> None:
        self.node.destroy_node()

    def listen(self, kind: Any, topic: str) -> None:
        """Collect a topic's messages from now on; return when the first one has come."""
        self.collect(kind, topic)
        self.until(lambda: self.heard[topic])

    def collect(self, kind: Any, topic: str) -> None:
        """Collect a topic's messages from now on."""
        self.heard[topic] = []
        self.node.create_subscription(kind, topic, self.heard[topic].append, DEPTH)

    def until(self, reached: Callable[[], Any], patience: float = PATIENCE) -> None:
        """Spin until something is so; fail when it takes too long."""
        end = monotonic() + patience
        while not reached():
            assert monotonic() < end, 'it did not happen'
            rclpy.spin_once(self.node, timeout_sec=0.05)

    def listeners(self) -> int:
        """Count who hears the forces of both wheels."""
        return min(force.get_subscription_count() for force in self._forces.values())

    def catch_up(self) -> 'Robot':
        """Drop what came while nobody listened."""
        idle = 0
        while idle < 2:  # rclpy ends every round of messages with a spin that brings none
            seen = sum(map(len, self.heard.values()))
            rclpy.spin_once(self.node, timeout_sec=0.0)
            idle = idle + 1 if sum(map(len, self.heard.values())) == seen else 0
        return self

    def hear(self, count: int) -> list[Odometry]:
        """Return the next odometry messages."""
        odom = self.heard['odom']
        odom.clear()
        self.until(lambda: len(odom) >= count)
        return odom[:count]

    def push(self, right: float, left: float, count: int) -> list[Odometry]:
        """Command forces at each odometry message; return these messages."""
        self.until(self.listeners)
        self.catch_up()
        seen = []
        for _ in range(count):
            for side, force in (('right', right), ('left', left)):
                message = WrenchStamped()
                message.wrench.force.x = force
                self._forces[side].publish(message)
            seen += self.hear(1)
        return seen

    def move(self, right: float, left: float) -> Odometry:
        """Push until the robot drives and turns; return the first message that says so.

        Forces may be late, or time out between two messages, where a machine is busy.
        """
        told: list[Odometry] = []

        def moves() -> bool:
            told[:] = self.push(right, left, 1)
            v, omega = twist_of(told[0])
            return v > 0.05 and abs(omega) > 0.01

        self.until(moves)
        return told[0]

    def publish_force(self, side: str, message: WrenchStamped) -> None:
        """Publish one command as it is."""
        self._forces[side].publish(message)

    @contextmanager
    def publishing(self, topic: str, message: Any) -> Iterator[None]:
        """Publish a message at 20 Hz, whenever the node spins."""
        publisher = self.node.create_publisher(type(message), topic, 10)
        timer = self.node.create_timer(0.05, lambda: publisher.publish(message))
        yield
        self.node.destroy_timer(timer)
        self.node.destroy_publisher(publisher)

    def answer(self, topic: str, about: Odometry) -> Any:
        """Publish odometry until a message that is collected bears its stamp; return the last."""
        heard = self.heard[topic]
        heard.clear()
        with self.publishing('odom', about):
            self.until(lambda: any(told.header.stamp == about.header.stamp for told in heard))
        return heard[-1]

    def call(self, kind: Any, service: str, request: Any) -> Any:
        client = self.node.create_client(kind, service)
        self.until(client.service_is_ready)
        future = client.call_async(request)
        self.until(future.done)
        self.node.destroy_client(client)
        return future.result()
