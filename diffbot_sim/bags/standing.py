"""What odometry says of a robot that stands: a gyro may turn even then."""

import numpy as np

from diffbot_sim.records import Array, Run

# Without force a robot may be seen standing after so long [s]; so many samples are asked.
COASTING, FEWEST = 0.5, 50
# What is less than this is no harm [m/s, rad/s]; what lies within so many deviations is noise.
HARMLESS, NOISE = 1e-3, 4.0
# A median is beyond chance at so many standard errors.
SURE = 6.0
# Where less than this share agrees, the robot moves.
MOST = 0.9


def turning(run: Run) -> float:
    """Return the yaw rate that odometry tells of a robot that stands [rad/s]; 0 where none."""
    noise = np.median(np.abs(np.diff(run.odometry.twist, axis=0)), axis=0) * 1.4826 / np.sqrt(2.0)
    reach = NOISE * noise + HARMLESS
    still = _unpushed(run) & (np.abs(run.odometry.twist[:, 0]) < reach[0])
    omega = run.odometry.twist[still, 1]
    if len(omega) < FEWEST:
        return 0.0
    middle = float(np.median(omega))
    agrees = np.mean(np.abs(omega - middle) < reach[1]) > MOST
    beyond_chance = abs(middle) > SURE * noise[1] / np.sqrt(len(omega)) + HARMLESS
    return middle if agrees and beyond_chance else 0.0


def _unpushed(run: Run) -> Array:
    """Return at which samples no force has acted for some time, shape (k,)."""
    given, time = run.commands, run.odometry.time
    ends = np.append(given.time[1:], np.inf)
    until = np.maximum.accumulate(np.where(np.any(given.force != 0.0, axis=1), ends, -np.inf))
    last = np.searchsorted(given.time, time, side='right') - 1
    return np.asarray(time > np.where(last >= 0, until[np.maximum(last, 0)], -np.inf) + COASTING)
