"""Which moment of a recording is now: it runs at a rate, stops and jumps."""

from math import inf
from time import monotonic

from diffbot_sim.records import NANOSECONDS


class Playhead:
    """Recorded time [ns] over wall time; it stands still until it has jumped somewhere."""

    def __init__(self, rate: float) -> None:
        self._rate = rate
        self._stamp, self._since = 0, monotonic()
        self.is_paused = False

    @property
    def now(self) -> int:
        """The recorded moment [ns] that is played now."""
        if self.is_paused:
            return self._stamp
        return self._stamp + round((monotonic() - self._since) * self._rate * NANOSECONDS)

    def jump(self, stamp: int) -> None:
        """Go on from another recorded moment [ns]."""
        self._stamp, self._since = stamp, monotonic()

    def toggle(self) -> None:
        """Pause, or go on from where it was paused."""
        self.jump(self.now)
        self.is_paused = not self.is_paused

    def until(self, stamp: int) -> float:
        """Return how long [s] it takes to reach a recorded moment [ns]; while paused, no end."""
        return inf if self.is_paused else (stamp - self.now) / NANOSECONDS / self._rate
