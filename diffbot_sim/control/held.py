"""A command that holds until the next one, or until it is too old."""

from dataclasses import dataclass

from diffbot_sim.records import NANOSECONDS


@dataclass(frozen=True)
class Held:
    """A commanded value and when it came [ns]; the default is no command at all."""

    value: float = 0.0
    stamp: int = 0

    def is_stale(self, now: int, timeout: float) -> bool:
        """Say whether the command is older than the timeout [s]; 0 never times out."""
        return timeout > 0.0 and now - self.stamp > timeout * NANOSECONDS

    def at(self, now: int, timeout: float) -> float:
        """Return the value at a moment [ns]: zero once it is stale."""
        return 0.0 if self.is_stale(now, timeout) else self.value
