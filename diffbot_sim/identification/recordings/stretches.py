"""Recorded runs as identification uses them: stretches to be fitted and to be held out."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from diffbot_sim.errors import DataError
from diffbot_sim.identification.recordings.acting import added_up
from diffbot_sim.identification.recordings.intervals import median_interval, usual_interval
from diffbot_sim.identification.recordings.unheard import Unheard, unheard
from diffbot_sim.identification.recordings.way import measured_heading, measured_way
from diffbot_sim.identification.statistics.norms import white_noise
from diffbot_sim.physics.state import State
from diffbot_sim.records import Array, Commands, Odometry, Run

# Faster odometry is averaged down to this rate [Hz]: noise falls, nothing of the motion is lost.
HIGHEST_RATE = 100.0
# Commands too [Hz]: each is a step of the integrator.
HIGHEST_COMMAND_RATE = 200.0
# Commands that are nearer than this share of their usual interval are of one moment.
AT_ONCE = 0.1
# Shares of each run that are fitted when no run is given for validation: at first, and where
# something begins in the rest.
FITTED_SHARE, LARGER_SHARE = 0.7, 0.85
# What a start is estimated from, and what is left out of fits after it [s].
START_WINDOW, SETTLING = 0.3, 0.5
FEWEST_SAMPLES = 50
# What comes later than this many intervals, which nine in ten keep, follows a loss.
LATEST = 1.5
# Samples that tell whether a stretch begins at rest.
FEW = 5


@dataclass(frozen=True)
class Stretch:
    """A part of a run with the commands of the whole run.

    time [s], shape (k,), counted from the start of the run; twist, shape (k, 2); heading [rad],
    shape (k,), as measured_heading tells; way [m] and turn [rad] since the wheels stood at angle
    0, shape (k, 2), as measured_way tells; start: state at time[0]; used: samples that count in
    fits, shape (k,); unheard: how errors count after commands that were lost; push: a force [N]
    and torque [N·m] that acts on the body after each sample, shape (k, 2), none unless given.
    """

    run: Run
    time: Array
    twist: Array
    heading: Array
    way: Array
    pose: Array | None
    start: State
    used: NDArray[np.bool_]
    unheard: Unheard
    push: Array | None = None

    @property
    def interval(self) -> float:
        """Median time between samples [s]."""
        return median_interval(self.time)

    @cached_property
    def intervals(self) -> Array:
        """Time since the sample before [s], the median at the first, shape (k,)."""
        return np.diff(self.time, prepend=self.time[0] - self.interval)

    @cached_property
    def counted(self) -> NDArray[np.intp]:
        """Which samples count in fits, by their numbers."""
        return np.flatnonzero(self.used)

    @property
    def pushes(self) -> Array:
        """The push after each sample, zeros where there is none, shape (k, 2)."""
        return np.zeros((len(self.time), 2)) if self.push is None else self.push

    def pushed(self, push: Array) -> 'Stretch':
        """Return the stretch with one more push, shape (k, 2)."""
        return replace(self, push=self.pushes + push)


def whole(runs: Sequence[Run]) -> tuple[Stretch, ...]:
    """Return each run as one stretch."""
    return tuple(_stretch(run, 0.0, 1.0) for run in map(thin, runs))


def split(
    runs: Sequence[Run], share: float = FITTED_SHARE
) -> tuple[tuple[Stretch, ...], tuple[Stretch, ...]]:
    """Return the first share of each run, to be fitted, and the rest, held out."""
    thinned = [thin(run) for run in runs]
    fitted = tuple(_stretch(run, 0.0, share) for run in thinned)
    held_out = tuple(_stretch(run, share, 1.0) for run in thinned)
    return fitted, held_out


def thin(run: Run) -> Run:
    """Average odometry and commands that are faster than their highest rates."""
    given, seen = _together(run.commands), run.odometry
    many, group = _surplus(given.time, HIGHEST_COMMAND_RATE), _surplus(seen.time, HIGHEST_RATE)
    if many > 1:
        given = _held_longer(given, many)
    if given is not run.commands:
        run = replace(run, commands=given)
    return averaged(run, group) if group > 1 else run


def averaged(run: Run, group: int) -> Run:
    """Return a run of which so many odometry samples have become one each.

    What is a mean since the sample before stays one; all else is of the middle of the samples.
    """
    seen = run.odometry
    pose = None if seen.pose is None else _averaged(seen.pose, group)
    time, twist = _averaged(seen.time, group), _averaged(seen.twist, group)
    middle = Odometry(time, twist, pose)
    return replace(run, odometry=_at_ends(seen, middle, group) if any(seen.means) else middle)


def _at_ends(seen: Odometry, middle: Odometry, group: int) -> Odometry:
    """Return odometry that was averaged, told at the last sample of each group."""
    count = len(middle.time) * group
    time, pose = seen.time[group - 1 : count : group], seen.pose
    twist = [
        told if mean else np.interp(time, middle.time, told)
        for told, mean in zip(middle.twist.T, seen.means, strict=True)
    ]
    pose = None if pose is None else pose[group - 1 : count : group]
    return Odometry(time, np.column_stack(twist), pose, seen.means)


def largest_command(stretches: Sequence[Stretch]) -> float:
    """Return the largest force that was commanded [N]."""
    return max(float(np.abs(stretch.run.commands.force).max()) for stretch in stretches)


def motion_of(stretches: Sequence[Stretch]) -> Array:
    """Return how far v and ω are spread around their means where they count, shape (2,)."""
    used = [stretch.twist[stretch.used] for stretch in stretches]
    return np.asarray(np.concatenate(used).std(axis=0))


def _surplus(time: Array, highest: float) -> int:
    """Return how many samples become one at most at the highest rate [Hz]."""
    interval = usual_interval(time)
    # But for rounding: half a sample more is one more.
    return int(round(1.0 / (interval * highest), 6) + 0.5) if interval > 0.0 else 1


def _together(given: Commands) -> Commands:
    """Return commands of which those of one tick, each wheel's with its own stamp, are one."""
    last = np.append(np.diff(given.time) > AT_ONCE * usual_interval(given.time), True)
    return given if last.all() else given.rows(last)


def _held_longer(given: Commands, many: int) -> Commands:
    """Return commands of which so many have become one each, of the same impulse."""
    count = (len(given.time) - 1) // many * many
    time = np.concatenate([given.time[:count:many], given.time[count:]])
    lasting = np.diff(time)[:, None]

    def longer(held: Array) -> Array:
        added = np.diff(added_up(given.time, held, time), axis=0)
        return np.concatenate([added / lasting, held[-1:]])

    unsure = None if given.unsure is None else longer(given.unsure)
    return Commands(time, longer(given.force), unsure)


def _averaged(values: Array, group: int) -> Array:
    count = len(values) // group
    whole = values[: count * group]
    return np.asarray(whole.reshape(count, group, *values.shape[1:]).mean(axis=1))


def _stretch(run: Run, begin: float, end: float) -> Stretch:
    odometry, count = run.odometry, len(run.odometry.time)
    part = slice(int(begin * count), int(end * count))
    time, twist = odometry.time[part], odometry.twist[part]
    used = _used(run.name, time)
    pose = None if odometry.pose is None else odometry.pose[part]
    heading = measured_heading(odometry)[part]
    way = measured_way(odometry)[part] + run.rolled
    travelled, turned = way[0]
    start = replace(
        _start(time, twist, pose, float(heading[0])),
        travelled=float(travelled),
        turned=float(turned),
    )
    lost = unheard(run.commands, time, twist, odometry.means)
    return Stretch(run, time, twist, np.ascontiguousarray(heading), way, pose, start, used, lost)


def _used(name: str, time: Array) -> NDArray[np.bool_]:
    """Return which samples count in fits; raises DataError where those are too few."""
    used = np.zeros(len(time), bool)
    if len(time) > FEW:
        used = (time > time[0] + SETTLING) & _in_time(time)
    if np.count_nonzero(used) < FEWEST_SAMPLES:
        raise DataError(
            f'{name}: {len(time)} odometry samples, at most {HIGHEST_RATE:g} a second, are too '
            f'few to fit or to judge by: those of the first {SETTLING:g} s do not count, and '
            f'{FEWEST_SAMPLES} must be left. Of a run that is divided {1.0 - FITTED_SHARE:.0%} '
            'are held out. Record longer, better two minutes.'
        )
    return used


def _in_time(time: Array) -> NDArray[np.bool_]:
    """Say of each sample whether none was lost before it, so that means are over an interval."""
    since = np.diff(time, prepend=time[0])
    return np.asarray(since <= LATEST * np.quantile(since[1:], 0.9))


def _intercept(time: Array, twist: Array) -> tuple[Array, float]:
    """Return a line's values at the first stamp, and their spread for noise of unit size."""
    design = np.column_stack([np.ones(len(time)), time - time[0]])
    inverse = np.linalg.pinv(design)
    return inverse[0] @ twist, float(np.linalg.norm(inverse[0]))


def _start(time: Array, twist: Array, pose: Array | None, heading: float) -> State:
    """Estimate the first state: a line through the first samples; rest where they allow it."""
    count = min(max(FEW, int(np.searchsorted(time, time[0] + START_WINDOW))), len(time))
    noise = white_noise(twist[:count])
    # The very first samples tell whether it rests: a push may set it in motion at once.
    at_first, spread = _intercept(time[:FEW], twist[:FEW])
    resting = np.all(np.abs(at_first) < 3.0 * noise * spread + 1e-9)
    v, omega = (0.0, 0.0) if resting else map(float, _intercept(time[:count], twist[:count])[0])
    x, y = (0.0, 0.0) if pose is None else (float(pose[0, 0]), float(pose[0, 1]))
    return State(x, y, heading, v, omega)
