"""When ticks are due on a steady clock."""

# A late node makes up for at most this many ticks in a row, so that commands get through.
CATCH_UP = 10


class Pace:
    """Counts the ticks that are due; late ones are made up for, within a limit."""

    def __init__(self, period: float, now: float) -> None:
        """Let a tick be due now and at every period [s] after it."""
        self.period = period
        self._next = now

    def left(self, now: float) -> float:
        """Return how long [s] it takes from now [s] to the next tick."""
        return self._next - now

    def due(self, now: float) -> tuple[int, int]:
        """Return how many ticks to make now [s], and how many are given up."""
        behind = max(int((now - self._next) / self.period) + 1, 0) if now >= self._next else 0
        self._next += behind * self.period
        return min(behind, CATCH_UP), max(behind - CATCH_UP, 0)
