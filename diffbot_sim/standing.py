"""What odometry says of a robot that stands: a gyro may turn even then."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from diffbot_sim.records import Array, Odometry, Run

# Without force, or counting nothing, a robot may be seen standing after so long [s]; so many
# samples are asked.
COASTING, FEWEST = 0.5, 10
# What is less than this is no harm [m/s, rad/s]; what lies within so many deviations is noise.
HARMLESS, NOISE = 1e-3, 4.0
# A median is beyond chance at so many standard errors.
SURE = 6.0
# Where less than this share agrees, the robot moves.
MOST = 0.9
# A gyro's bias changes by less than this share of it.
CHANGED = 0.5
# No gyro has a greater bias [rad/s]: who turns faster and counts nothing turns on the spot.
GREATEST = 0.1

# A pose that moves so far [m], or turns so far [rad], is not one of a robot that stands.
MOVED, TURNED = 0.2, 0.5


class Turning(NamedTuple):
    """The yaw rate that odometry tells of a robot that stands, and its standard error [rad/s]."""

    rate: float
    error: float

    @property
    def is_told(self) -> bool:
        """Whether it is beyond chance, and no trifle."""
        return abs(self.rate) > SURE * self.error + HARMLESS


NOTHING = Turning(0.0, 0.0)


def turning(run: Run) -> Turning:
    """Return how odometry turns while the robot stands; nothing where that is not seen."""
    twist = run.odometry.twist
    noise = _noise(twist)
    reach = NOISE * noise + HARMLESS
    resting = _uncounted(run) & (np.abs(twist[:, 1]) < GREATEST)
    omega = twist[(_unpushed(run) | resting) & (np.abs(twist[:, 0]) < reach[0]), 1]
    if len(omega) < FEWEST:
        return NOTHING
    told = Turning(float(np.median(omega)), float(noise[1] / np.sqrt(len(omega))))
    agrees = np.mean(np.abs(omega - told.rate) < reach[1]) > MOST
    return told if agrees and _is_steady(omega, told) else NOTHING


def is_moving(twist: Array) -> bool:
    """Say whether twists, shape (k, 2), are those of a robot that moves, beyond noise and bias."""
    reach = NOISE * _noise(twist) + [HARMLESS, GREATEST]
    return bool(np.any(np.sqrt(np.mean(twist**2, axis=0)) > reach))


def _noise(twist: Array) -> Array:
    """Return the noise of twists that mostly hardly change, shape (2,)."""
    if len(twist) < 2:
        return np.zeros(2)
    changes = np.abs(np.diff(twist, axis=0))
    return np.asarray(np.median(changes, axis=0) * 1.4826 / np.sqrt(2.0))


def unfilled(odometry: Odometry) -> tuple[bool, bool]:
    """Say of v, and of ω, whether it is 0 throughout though the pose moves: nobody filled it."""
    if odometry.pose is None:
        return False, False
    x, y, yaw = np.ptp(odometry.pose, axis=0)
    moved = (max(x, y) > MOVED, yaw > TURNED)
    v, omega = (
        bool(m and not told.any()) for m, told in zip(moved, odometry.twist.T, strict=True)
    )
    return v, omega


def _is_steady(omega: Array, told: Turning) -> bool:
    """Say whether early and late yaw rates agree: who slides down a slope turns ever faster."""
    early, late = (float(np.median(part)) for part in np.array_split(omega, 2))
    return abs(late - early) < max(CHANGED * abs(told.rate), 2.0 * SURE * told.error)


def _uncounted(run: Run) -> NDArray[np.bool_]:
    """Return at which samples the speed has been exactly none for some time, shape (k,)."""
    time, rolls = run.odometry.time, run.odometry.twist[:, 0] != 0.0
    last = np.maximum.accumulate(np.where(rolls, time, time[0]))
    return np.asarray(time > last + COASTING)


def _unpushed(run: Run) -> NDArray[np.bool_]:
    """Return at which samples no force has acted for some time, shape (k,)."""
    given, time = run.commands, run.odometry.time
    ends = np.append(given.time[1:], np.inf)
    until = np.maximum.accumulate(np.where(np.any(given.force != 0.0, axis=1), ends, -np.inf))
    last = np.searchsorted(given.time, time, side='right') - 1
    return np.asarray(time > np.where(last >= 0, until[np.maximum(last, 0)], -np.inf) + COASTING)
