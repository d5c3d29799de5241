"""When ticks are due on a steady clock."""

# A late node makes at most this many ticks in a row, so that commands get through in between.
AT_ONCE = 10
# It stays in debt for at most so long [s], and gives up what is older.
LONGEST_DEBT = 1.0


class Pace:
    """Counts the ticks that are due; late ones are made up for, within a limit."""

    def __init__(self, period: float, now: float) -> None:
        """Let a tick be due now and at every period [s] after it."""
        self.period = period
        self._next = now
        self._bearable = max(1, int(LONGEST_DEBT / period))

    def left(self, now: float) -> float:
        """Return how long [s] it takes from now [s] to the next tick."""
        return self._next - now

    def due(self, now: float) -> tuple[int, int]:
        """Return how many ticks to make now [s], and how many are given up."""
        behind = max(int((now - self._next) / self.period) + 1, 0) if now >= self._next else 0
        given_up = max(behind - self._bearable, 0)
        made = min(behind - given_up, AT_ONCE)
        self._next += (made + given_up) * self.period
        return made, given_up
