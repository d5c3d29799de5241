"""How simulation time advances: on a steady clock, or in step with who commands the wheels."""

from collections.abc import Callable
from math import inf
from time import monotonic

from rclpy.clock import Clock, ClockType
from rclpy.node import Node

from diffbot_sim.nodes.pace import Pace
from diffbot_sim.records import NANOSECONDS, SIDES

SHORTEST_TIMER = 1e-3  # [s]; the executor cannot wake more often to any use
LONGEST_TIMER = 3600.0  # [s]; one that wakes too early finds nothing due
NO_TIMER = 1e-6  # [s]; a tick at every turn of the executor
UNANSWERED = 1.0  # [s] after which a tick that nobody answers is told once more
QUIET = 5.0  # [s] between repeated warnings

Act = Callable[[], None]


class OnClock:
    """Ticks on a steady clock; who commands late is not waited for."""

    def __init__(self, node: Node, show: Act, advance: Act) -> None:
        self._node, self._show, self._advance = node, show, advance
        self._pace: Pace | None = None
        self._timer = node.create_timer(1.0, self._on_timer, clock=steady_clock())
        self._timer.cancel()

    def start(self, period: float) -> None:
        """Tick at every period [s] of wall time from now on; 0: as fast as it goes."""
        self._pace = Pace(period, monotonic()) if period else None
        wake = min(max(period, SHORTEST_TIMER), LONGEST_TIMER) if period else NO_TIMER
        self._timer.timer_period_ns = round(wake * NANOSECONDS)
        self._timer.reset()

    def stop(self) -> None:
        """Let time stand still."""
        self._timer.cancel()

    def step(self) -> None:
        """Make a single tick, while time stands still."""
        self._show()
        self._advance()

    def restart(self) -> None:
        """Go on after a robot was moved: nothing is waited for."""

    def heard(self, side: str) -> None:
        """Take note of a command: it counts from the next tick on."""

    def _on_timer(self) -> None:
        due, given_up = self._pace.due(monotonic()) if self._pace else (1, 0)
        for _ in range(due):
            self.step()
        if given_up:
            self._node.get_logger().warning(
                f'too slow: {given_up} ticks late; simulation time falls behind',
                throttle_duration_sec=QUIET,
            )


class Lockstep:
    """Shows a tick, waits until both wheels have been commanded, and only then makes the next.

    What nobody answers is shown again, since who commands may not have been there yet.
    """

    def __init__(self, node: Node, show: Act, repeat: Act, advance: Act) -> None:
        self._show, self._repeat, self._advance = show, repeat, advance
        self._awaited: set[str] = set()
        self._allowed = 0.0
        self._shown = False
        self._timer = node.create_timer(UNANSWERED, self._on_timer, clock=steady_clock())

    def start(self, period: float) -> None:
        """Let time advance; how fast is up to those who answer."""
        del period
        self._allow(inf)

    def stop(self) -> None:
        """Let time stand still."""
        self._allowed = 0.0

    def step(self) -> None:
        """Let time advance by a single tick, once it has been answered."""
        self._allow(self._allowed + 1.0)

    def restart(self) -> None:
        """Show the tick anew after a robot was moved, and wait for both wheels."""
        if self._shown:
            self._show_next()

    def heard(self, side: str) -> None:
        """Take note of a command; the second one lets time advance."""
        self._timer.reset()
        self._awaited.discard(side)
        self._go_on()

    def _allow(self, ticks: float) -> None:
        self._allowed = ticks
        if not self._shown:
            self._show_next()
        self._go_on()

    def _go_on(self) -> None:
        if self._shown and not self._awaited and self._allowed:
            self._advance()
            self._allowed -= 1.0
            self._show_next()

    def _show_next(self) -> None:
        self._awaited, self._shown = set(SIDES), True
        self._show()

    def _on_timer(self) -> None:
        if self._shown and self._awaited:
            self._repeat()


def steady_clock() -> Clock:
    """Return a clock that nothing sets and no simulation time replaces."""
    return Clock(clock_type=ClockType.STEADY_TIME)
