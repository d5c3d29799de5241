"""What the simulator node costs, and how late it is, beside a node that only publishes."""

import argparse
import os
import random
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from statistics import median
from time import monotonic, time_ns
from typing import Any

from diffbot_sim.commands._processes import free_domain

# Before ROS starts: hear no other robot on this machine or beyond it.
os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE'] = 'LOCALHOST'
os.environ['ROS_DOMAIN_ID'] = str(free_domain())

import numpy as np
import rclpy
from bare_node import KINDS
from geometry_msgs.msg import WrenchStamped
from nav_msgs.msg import Odometry
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node

ROOT = Path(__file__).parents[1]
SETTLING = 2.0  # [s] after the first message
PATIENCE = 60.0  # [s]
PROBES = 100
QUEUE = 5000
Figures = dict[str, float]


def command(name: str, rate: float) -> list[str]:
    """Return how to start a node."""
    if name == 'bare':
        return [sys.executable, str(ROOT / 'benchmarks' / 'bare_node.py'), str(rate)]
    words = ('-p', f'publish_rate:={rate}', '-p', 'physics_step:=0.001')
    return [sys.executable, '-m', 'diffbot_sim', 'simulator', '--ros-args', *words]


@contextmanager
def running(words: list[str]) -> Iterator[int]:
    """Run a node until the end of the block; yield its process id."""
    process = subprocess.Popen(words, cwd=ROOT, stderr=subprocess.DEVNULL)
    try:
        yield process.pid
    finally:
        process.terminate()
        process.wait()


def cpu(pid: int) -> float:
    """Return the user and system time [s] of a process so far."""
    fields = Path(f'/proc/{pid}/stat').read_text().rpartition(')')[2].split()
    return sum(map(int, fields[11:13])) / os.sysconf('SC_CLK_TCK')


class Listener:
    """Answers each odometry message with two forces, as the inner loop does."""

    def __init__(self) -> None:
        self.node, self._silent = Node('listener'), Node('silent')
        # Never spun: its messages arrive and cost their publisher, but not this process.
        for topic, kind in KINDS.items():
            if topic != 'odom':
                self._silent.create_subscription(kind, topic, lambda _: None, 1)
        self._executor = SingleThreadedExecutor()
        self._executor.add_node(self.node)
        self._forces = [
            self.node.create_publisher(WrenchStamped, f'{side}_wheel/force_cmd', 10)
            for side in ('right', 'left')
        ]
        self.published: list[int] = []
        self._odom = self.node.create_subscription(
            Odometry, 'odom', self._on_odom, QUEUE, raw=True
        )

    def close(self) -> None:
        """End both nodes."""
        self.node.destroy_node()
        self._silent.destroy_node()

    def _on_odom(self, _: bytes, info: Any) -> None:
        self.published.append(info['source_timestamp'])
        self.push(1.0)

    def push(self, force: float) -> None:
        """Command the same force [N] at both wheels."""
        message = WrenchStamped()
        message.wrench.force.x = force
        for publisher in self._forces:
            publisher.publish(message)

    def until(self, reached: Callable[[], Any], patience: float = PATIENCE) -> None:
        """Spin until something is so or patience [s] ends."""
        end = monotonic() + patience
        while not reached() and monotonic() < end:
            self._executor.spin_once(timeout_sec=0.05)

    def late(self, rate: float) -> list[float]:
        """Return how late [s] forces of random phase appear among the forces taken."""
        self.node.destroy_subscription(self._odom)
        told: dict[float, int] = {}

        def tell(message: WrenchStamped) -> None:
            told.setdefault(message.wrench.force.x, time_ns())

        self.node.create_subscription(WrenchStamped, 'left_wheel/force', tell, QUEUE)
        self.until(lambda: told)
        return [self._lateness(1.0 + k / 1000, told, rate) for k in range(1, PROBES + 1)]

    def _lateness(self, force: float, told: dict[float, int], rate: float) -> float:
        self.until(lambda: False, 0.02 + random.random() / rate)
        sent = time_ns()
        self.push(force)
        self.until(lambda: force in told)
        return (told[force] - sent) / 1e9


def measure(name: str, rate: float, seconds: float) -> Figures:
    """Start a node, hear it for some seconds and tell what it cost and how late it was."""
    listener = Listener()
    with running(command(name, rate)) as pid:
        listener.until(lambda: listener.published)
        starting = cpu(pid)
        listener.until(lambda: False, SETTLING)
        listener.published.clear()
        before = cpu(pid)
        listener.until(lambda: False, seconds)
        spent, published = cpu(pid) - before, np.array(listener.published) / 1e9
        late = np.array(listener.late(rate)) * rate
    listener.close()
    return {
        'CPU time per tick [µs]': spent / len(published) * 1e6,
        'CPU time to start [s]': starting,
        'ticks per second': len(published) / seconds,
        'jitter, 95 % [ms]': float(np.quantile(abs(np.diff(published) - 1.0 / rate), 0.95)) * 1e3,
        'latency, median [ticks]': float(np.median(late)),
        'latency, 95 % [ticks]': float(np.quantile(late, 0.95)),
    }


def table(rate: float, ours: list[Figures], bare: list[Figures]) -> str:
    """Return the medians of all rounds, and their ratios, as Markdown."""
    lines = [f'| at {rate:g} Hz | simulator | bare node | ratio |', '|---|--:|--:|--:|']
    for key in ours[0]:
        one, other = (median(figures[key] for figures in node) for node in (ours, bare))
        lines.append(f'| {key} | {one:.3g} | {other:.3g} | {one / other:.2f} |')
    return '\n'.join(lines)


def main() -> None:
    """Alternate between the nodes and print a table for each rate."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument('--rates', type=float, nargs='+', default=[100.0, 1000.0])
    options.add_argument('--seconds', type=float, default=20.0)
    options.add_argument('--rounds', type=int, default=3)
    chosen = options.parse_args()
    rclpy.init()
    for rate in chosen.rates:
        rounds = [
            {name: measure(name, rate, chosen.seconds) for name in ('simulator', 'bare')}
            for _ in range(chosen.rounds)
        ]
        print(table(rate, *([r[name] for r in rounds] for name in ('simulator', 'bare'))), '\n')


if __name__ == '__main__':
    main()
