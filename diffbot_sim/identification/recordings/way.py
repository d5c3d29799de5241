"""The way that a robot has come, and its heading: wheel angles and slopes hang on them.

A twist's noise, added up, is a random walk; so are the errors of a predictor. A pose that was not
made of the twist has none of that, but noise of its own, which adds up where the robot turns.
"""

import numpy as np
from scipy.ndimage import uniform_filter1d

from diffbot_sim.identification.recordings.intervals import median_interval
from diffbot_sim.identification.statistics.norms import rms_of_each, white_noise
from diffbot_sim.physics.kinematics import integral, path_of
from diffbot_sim.records import Array, Odometry

# Over which time what a pose tells beyond its twist is smoothed, and after which it is held
# against itself [s].
SMOOTH, LATER = 1.0, 5.0
# How far pose and twist part in that time, in what the twist's noise adds up to. Less: the pose is
# the twist's own sum. More: they tell of different motions.
LEAST, MOST = 0.5, 10.0
# A heading was made of the twist if most of its large steps are those, but for this share.
ROUNDED = 1e-3
# A way [m] and a turn [rad] that are as good as none.
TINY = 1e-12


def measured_way(odometry: Odometry) -> Array:
    """Return way [m] and turn [rad] since the first sample, shape (k, 2).

    As the twist adds up, or as the pose tells where that knows more.
    """
    added = _sum_of_twists(odometry)
    beyond = _beyond(odometry, added)
    return added if beyond is None else added + beyond


def pose_knows_more(odometry: Odometry) -> bool:
    """Say whether there is a pose that was not made of the twists, and knows more than they do."""
    return _beyond(odometry, _sum_of_twists(odometry)) is not None


def measured_heading(odometry: Odometry) -> Array:
    """Return the heading at each stamp [rad], shape (k,), as the pose tells, or the twist.

    A pose that adds up turn rates of the moment, each over a whole interval, is half a step ahead
    or behind where the robot turns: that is taken out.
    """
    time, rate, mean = odometry.time, odometry.twist[:, 1], odometry.means[1]
    if odometry.pose is None:
        return _added_up(time, rate, mean)
    heading = odometry.pose[:, 2]
    return heading if mean else _of_the_moment(time, heading, rate)


def _of_the_moment(time: Array, heading: Array, rate: Array) -> Array:
    """Return a heading without the half step that it owes to added-up rates, if it does."""
    turned, steps = np.diff(heading), np.diff(time)
    half = 0.5 * np.append(steps[0], steps) * rate
    if _is_made_of(turned, steps * rate[1:]):
        return np.asarray(heading - half)
    if _is_made_of(turned, steps * rate[:-1]):
        return np.asarray(heading + half)
    return heading


def _is_made_of(turned: Array, added: Array) -> bool:
    """Say whether a heading turned as rates add up, but where samples are lost."""
    size = np.abs(added)
    large = size >= size.mean()
    return bool(np.median(np.abs(turned - added)[large]) < ROUNDED * size.mean())


def _beyond(odometry: Odometry, added: Array) -> Array | None:
    """Return way [m] and turn [rad] that a pose tells beyond the sum of the twists, shape (k, 2).

    None where there is no pose, it was made of the twists, or it knows less than they do.
    """
    if odometry.pose is None:
        return None
    told, smooth = path_of(odometry.pose), _samples(odometry, SMOOTH)
    beyond = uniform_filter1d(told - told[0] - added, smooth, axis=0, mode='nearest')
    beyond -= beyond[0]
    return beyond if _knows_more(odometry, odometry.pose, beyond) else None


def _sum_of_twists(odometry: Odometry) -> Array:
    rates = zip(odometry.twist.T, odometry.means, strict=True)
    return np.column_stack([_added_up(odometry.time, rate, mean) for rate, mean in rates])


def _added_up(time: Array, rate: Array, mean: bool) -> Array:
    """Return what a rate adds up to; mean: whether it is one since the sample before."""
    if not mean:
        return integral(time, rate)
    return np.concatenate([[0.0], np.cumsum(np.diff(time) * rate[1:])])


def _knows_more(odometry: Odometry, pose: Array, beyond: Array) -> bool:
    """Say whether a pose is not the twist's sum, tells of the same motion, and has less noise.

    beyond: way and turn that it tells beyond the twist, shape (k, 2).
    """
    later = _samples(odometry, LATER)
    if len(beyond) <= later:
        return False
    step = white_noise(odometry.twist) * median_interval(odometry.time)
    parted = rms_of_each(beyond[later:] - beyond[:-later])
    parted /= step * np.sqrt(later) + TINY
    # Noise of a place cancels from step to step but for the turn between.
    own = white_noise(pose[:, :2]).max() * np.linalg.norm(np.diff(pose[:, 2]))
    less = own < step[0] * np.sqrt(len(beyond))
    return bool(less and np.all((parted >= LEAST) & (parted <= MOST)))


def _samples(odometry: Odometry, span: float) -> int:
    """Return how many samples lie in a span of time [s], at least one."""
    return max(1, round(span / median_interval(odometry.time)))
