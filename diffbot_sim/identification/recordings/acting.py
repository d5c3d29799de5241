"""Forces that acted at other times than they are stamped."""

from dataclasses import replace

from diffbot_sim.records import Run


def acted_before(run: Run, lead: float) -> Run:
    """Return a run whose forces acted so long before their stamps [s]; negative: after."""
    given = run.commands
    return replace(run, commands=replace(given, time=given.time - lead))
