"""Parts of a run that was not recorded all along: the motion in between is not known."""

from collections.abc import Sequence
from dataclasses import replace
from math import inf

from diffbot_sim.errors import DataError
from diffbot_sim.identification.recordings.stretches import split
from diffbot_sim.records import Odometry, Run


def between(run: Run, pauses: Sequence[tuple[float, float]]) -> tuple[Run, ...]:
    """Return what of a run lies between its pauses, from and to [s], as runs of their own.

    Their time goes on counting from the start of the whole. What is too short to be fitted is
    left out; a run none of whose parts is longer stays whole.
    """
    if not pauses:
        return (run,)
    begins = [-inf, *(until for _, until in pauses)]
    ends = [*(since for since, _ in pauses), inf]
    parts = [_part(run, begin, end) for begin, end in zip(begins, ends, strict=True)]
    return tuple(filter(_is_enough, parts)) or (run,)


def _part(run: Run, begin: float, end: float) -> Run:
    """Return the odometry of a span [s] with the commands of the whole run."""
    seen = run.odometry
    kept = (seen.time >= begin) & (seen.time <= end)
    pose = None if seen.pose is None else seen.pose[kept]
    part = Odometry(seen.time[kept], seen.twist[kept], pose, seen.means)
    return replace(run, name=f'{run.name} from {max(begin, 0.0):.0f} s on', odometry=part)


def _is_enough(part: Run) -> bool:
    """Say whether a part can be divided into what is fitted and what is held out."""
    try:
        split([part])
    except DataError:
        return False
    return True
