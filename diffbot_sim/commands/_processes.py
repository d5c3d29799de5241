"""Starts the package's own nodes as processes and ends them cleanly."""

import os
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from time import monotonic, sleep

from diffbot_sim.errors import DiffbotError

PATIENCE = 60.0  # [s] for a node to start or to end; the first start compiles
LOOK_AGAIN = 0.05
# Domains whose ports lie below those that Linux gives out itself.
DOMAINS = 100


def free_domain() -> int:
    """Return a ROS domain that nobody on this machine is in, so that nobody is disturbed."""
    first = os.getpid() % DOMAINS
    others = (1 + (first + step) % DOMAINS for step in range(DOMAINS))
    return next((domain for domain in others if _is_free(domain)), 1 + first)


def _is_free(domain: int) -> bool:
    """Say whether nobody listens on the first port of a domain: DDSI-RTPS, 9.6.2.3."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as door:
        try:
            door.bind(('', 7410 + 250 * domain))
        except OSError:
            return False
    return True


class Process:
    """One node; what it says goes to a log file."""

    def __init__(self, node: str, words: Sequence[str], log: Path, domain: int) -> None:
        self.node, self._log = node, log
        surroundings = {
            'ROS_DOMAIN_ID': str(domain),
            'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST',
        }
        with log.open('w') as sink:
            self._process = subprocess.Popen(
                [sys.executable, '-m', 'diffbot_sim', node, *words],
                stdout=sink,
                stderr=subprocess.STDOUT,
                env=os.environ | surroundings,
            )

    def wait_for(self, text: str) -> None:
        """Wait until the node says something; raises DiffbotError if it dies before that."""
        deadline = monotonic() + PATIENCE
        while text not in self._log.read_text():
            if self._process.poll() is not None or monotonic() > deadline:
                raise DiffbotError(f'{self.node} did not start: see {self._log}')
            sleep(LOOK_AGAIN)

    def wait(self, patience: float) -> None:
        """Wait until the node ends by itself."""
        try:
            code = self._process.wait(patience)
        except subprocess.TimeoutExpired as error:
            raise DiffbotError(f'{self.node} did not end in time: see {self._log}') from error
        if code != 0:
            raise DiffbotError(f'{self.node} failed: see {self._log}')

    def stop(self) -> None:
        """Ask the node to end, and make it."""
        if self._process.poll() is None:
            self._process.send_signal(signal.SIGINT)
        try:
            self._process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            self._process.kill()


@contextmanager
def stopped_at_end() -> Iterator[list[Process]]:
    """Hold processes in a list and end them in reverse order, whatever happens."""
    processes: list[Process] = []
    try:
        yield processes
    finally:
        for process in reversed(processes):
            process.stop()
