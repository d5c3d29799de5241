"""A robot as quickly written simulators have it: Euler's steps, friction smoothed by a tanh."""

from math import cos, sin, tanh

import numpy as np
from rehearsal import random_forces

from diffbot_sim.records import Array, Odometry, Run

STEP = 0.01  # [s]
MASS, INERTIA, HALF = 10.0, 0.4, 0.2
CREEP = 0.01  # speed below which wheels creep rather than stick [m/s]
GRAVITY = 9.81


def driven_by_euler(grade: float, seed: int, duration: float = 60.0) -> Run:
    """Return a drive without noise on a floor that falls along x by so much, at 50 Hz."""
    drive = random_forces(seed, duration, -9.0, 11.0)
    time = STEP * np.arange(round(duration / STEP))
    force = drive.force[np.searchsorted(drive.time, time + 1e-9, 'right') - 1]
    state, states = np.zeros(5), []
    for pull in force:
        states.append(state)
        state = state + STEP * _rate(state, pull, grade)
    seen = np.array(states)[::2]
    return Run('euler', drive, Odometry(time[::2], seen[:, 3:], seen[:, :3]))


def _rate(state: Array, pull: Array, grade: float) -> Array:
    """Return the change of x, y, heading, v and ω in a second."""
    _, _, heading, v, omega = state
    right, left = pull[0] - _rub(v + HALF * omega), pull[1] - _rub(v - HALF * omega)
    pushing = right + left + MASS * GRAVITY * grade * cos(heading)
    change = pushing / MASS, HALF * (right - left) / INERTIA
    return np.array([v * cos(heading), v * sin(heading), omega, *change])


def _rub(speed: float) -> float:
    """Return the friction of a wheel [N]."""
    return tanh(speed / CREEP) * (1.5 + 0.9 * np.exp(-25.0 * abs(speed))) + 3.9 * speed
