"""Whether the recordings are wired as they should be: sides, signs, units and clocks."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from scipy.signal import correlate, correlation_lags

from diffbot_sim.identification.fitting.calibration import simulation_errors
from diffbot_sim.identification.fitting.coordinates import Space
from diffbot_sim.identification.fitting.fit import WORST
from diffbot_sim.identification.fitting.predictor import NO_GAIN, predict
from diffbot_sim.identification.recordings.acting import acted_before
from diffbot_sim.identification.recordings.recordings import Recordings
from diffbot_sim.identification.recordings.stretches import Stretch, motion_of
from diffbot_sim.identification.statistics.norms import rms_of_each, white_noise
from diffbot_sim.records import Array, Commands, Run

# It is a fault if without it less than such shares are left of the motion, and of the error.
OF_MOTION, OF_ERROR = 0.75, 0.5
# What moves by less than so many times its noise is not asked.
BEYOND_NOISE, NOTHING = 5.0, 1e-9
# Clocks that differ by less [s] may be an actuator's delay; by more they are not looked for.
LEAST_LATE, MOST_LATE = 1.0, 30.0
# Interval at which lateness is looked for [s].
INTERVAL = 0.02


@dataclass(frozen=True)
class Fault:
    """A fault of a recording, in words; how the run is without it, and which axes it spoils."""

    words: str
    mended: Callable[[Run], Run]
    axes: tuple[int, ...]


def _driven(run: Run, by: Array) -> Run:
    """Return a run with other forces: by, shape (2, 2), times what was told of right and left."""
    given = run.commands
    unsure = None if given.unsure is None else given.unsure @ np.square(by.T)
    return replace(run, commands=Commands(given.time, given.force @ by.T, unsure))


def _rescaled(run: Run, units: Array) -> Run:
    return replace(run, odometry=replace(run.odometry, twist=run.odometry.twist * units))


RIGHT_FLIPPED, LEFT_FLIPPED = np.diag([-1.0, 1.0]), np.diag([1.0, -1.0])
EXCHANGED = np.array([[0.0, 1.0], [1.0, 0.0]])
FAULTS = (
    Fault(
        'left and right were exchanged, or the turn rate had the other sign',
        partial(_driven, by=EXCHANGED),
        (1,),
    ),
    # That turns the sign of the sum of both, and leaves their difference as it is.
    Fault('the speed had the other sign', partial(_driven, by=-EXCHANGED), (0,)),
    Fault('both forces had the other sign', partial(_driven, by=-np.eye(2)), (0, 1)),
    Fault(
        'the force of the right wheel had the other sign',
        partial(_driven, by=RIGHT_FLIPPED),
        (0, 1),
    ),
    Fault(
        'the force of the left wheel had the other sign', partial(_driven, by=LEFT_FLIPPED), (0, 1)
    ),
    Fault('the forces were told in mN', partial(_driven, by=1e-3 * np.eye(2)), (0, 1)),
    Fault('the forces were told in kN', partial(_driven, by=1e3 * np.eye(2)), (0, 1)),
    Fault('the speed was told in mm/s', partial(_rescaled, units=np.array([1e-3, 1.0])), (0,)),
    Fault('the speed was told in cm/s', partial(_rescaled, units=np.array([1e-2, 1.0])), (0,)),
    Fault(
        'the turn rate was told in degrees',
        partial(_rescaled, units=np.array([1.0, np.pi / 180.0])),
        (1,),
    ),
)


def fault_of(recordings: Recordings, space: Space) -> Fault | None:
    """Return the fault without which the declared model tells most of the motion, if there is one.

    None where it tells that already, or where no fault accounts for what it does not.
    """
    fitted, _ = recordings.divided
    unexplained = _shares(fitted, space)
    if not np.any(unexplained > OF_MOTION):
        return None
    most = np.minimum(OF_MOTION, OF_ERROR * unexplained)
    best, least = None, np.inf
    for fault in (*FAULTS, *_clocks(fitted, space)):
        without, _ = recordings.each(fault.mended).divided
        left = _shares(without, space)
        spoilt = [axis for axis in fault.axes if np.isfinite(left[axis])]
        if spoilt and np.all(left[spoilt] < most[spoilt]) and np.nansum(left) < least:
            best, least = fault, float(np.nansum(left))
    return best


def _shares(stretches: tuple[Stretch, ...], space: Space) -> Array:
    """Return which share of the motion a declared model errs by, for v and ω.

    Around its mean; not a number where it hardly moves.
    """
    motion = motion_of(stretches)
    noise = rms_of_each(np.array([white_noise(s.twist[s.used]) for s in stretches]))
    error = rms_of_each(simulation_errors(space, stretches, space.prior()))
    moves = motion > BEYOND_NOISE * noise + NOTHING
    return np.where(moves, error / np.where(moves, motion, 1.0), np.nan)


def _clocks(stretches: tuple[Stretch, ...], space: Space) -> Iterator[Fault]:
    """Yield the fault of clocks that differ by what the motion is later than the declared one."""
    late = {stretch.run.name: _lateness(stretch, space) for stretch in stretches}
    wrong = {name: lag for name, lag in late.items() if abs(lag) > LEAST_LATE}
    if wrong:
        most = max(wrong.values(), key=abs)
        later = 'later' if most > 0.0 else 'earlier'
        of = '' if len(wrong) == len(late) else f' of {", ".join(wrong)}'
        words = f'the odometry{of} was stamped about {abs(most):.1f} s {later} than the forces'
        yield Fault(words, partial(_set_right, late=wrong), (0, 1))


def _set_right(run: Run, late: Mapping[str, float]) -> Run:
    """Return a run whose forces act as much later as its odometry was stamped late [s]."""
    return acted_before(run, -late.get(run.name, 0.0))


def _lateness(stretch: Stretch, space: Space) -> float:
    """Return by how much what was measured comes after what is simulated [s]."""
    missed = predict(space.model(space.prior()), stretch, NO_GAIN).innovation
    # Numbers in another unit may move a robot faster than can be squared.
    simulated = stretch.twist - np.clip(missed, -WORST, WORST)
    time = np.arange(stretch.time[0], stretch.time[-1], INTERVAL)
    measured, told = (_levelled(time, stretch.time, x) for x in (stretch.twist, simulated))
    alike = sum(correlate(m, t) for m, t in zip(measured, told, strict=True))
    lags = correlation_lags(len(time), len(time)) * INTERVAL
    near = np.abs(lags) <= MOST_LATE
    return float(lags[near][int(np.argmax(alike[near]))])


def _levelled(at: Array, time: Array, twist: Array) -> list[Array]:
    """Return v and ω at moments, around their means and of unit size."""
    levelled = (np.interp(at, time, rate) - rate.mean() for rate in twist.T)
    return [rate / max(float(np.linalg.norm(rate)), 1e-12) for rate in levelled]
