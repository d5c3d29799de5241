"""Forces that acted at other times than they are stamped, and what they did until some moment."""

from dataclasses import replace

import numpy as np

from diffbot_sim.records import Array, Run


def acted_before(run: Run, lead: float) -> Run:
    """Return a run whose forces acted so long before their stamps [s]; negative: after."""
    given = run.commands
    return replace(run, commands=replace(given, time=given.time - lead))


def added_up(stamps: Array, held: Array, until: Array) -> Array:
    """Return what is held from each stamp to the next, (n, q), added up to moments [s]: (k, q)."""
    ends = np.append(stamps, max(float(stamps[-1]), float(until[-1])) + 1e-9)
    added = np.vstack([np.zeros(held.shape[1]), np.cumsum(np.diff(ends)[:, None] * held, axis=0)])
    return np.column_stack([np.interp(until, ends, column) for column in added.T])
