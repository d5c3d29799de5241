"""What a recorder writes down of a drive of the peer plant."""

from dataclasses import dataclass

import numpy as np
from peer_drives import Driver
from peer_plant import Plant
from peer_stepping import STEP, YAW, X, advance, at_rest
from scipy.signal import lfilter

from diffbot_sim.records import Array, Commands, Odometry, Run

BEAT = 0.01  # pushes of the floor change every beat [s]


@dataclass(frozen=True)
class Recording:
    """How a drive is recorded, and what disturbs it.

    duration [s]; rate of the commands and of the odometry, 50 or 100 [Hz]; v_noise [m/s] and
    omega_noise [rad/s]: standard deviations of white odometry noise; roughness: rms force of the
    floor on each wheel [N], with a memory [s]; dead_reckoned: the pose is the integral of the
    noisy twist, not true; hears_all: who drives hears true speeds, at every beat.
    """

    duration: float = 120.0
    rate: float = 50.0
    odometry: float = 50.0
    v_noise: float = 0.004
    omega_noise: float = 0.008
    roughness: float = 0.0
    memory: float = 0.3
    dead_reckoned: bool = False
    hears_all: bool = False


def record(plant: Plant, driver: Driver, how: Recording, seed: int, name: str = 'peer') -> Run:
    """Drive from rest, measure as one drives, and return what was recorded."""
    random = np.random.default_rng([seed, 3])
    beats = round(how.duration / BEAT)
    push = how.roughness * remembering(random, beats, BEAT / how.memory)
    noise = random.normal(size=(beats, 2)) * [how.v_noise, how.omega_noise]
    each, odometry = round(1.0 / (how.rate * BEAT)), round(1.0 / (how.odometry * BEAT))
    often, missed = (1, np.zeros_like(noise)) if how.hears_all else (odometry, noise)
    (state, way), force = at_rest(plant), np.zeros((beats // each, 2))
    motion, measured = np.empty((beats, 5)), np.zeros(2)
    for k in range(beats):
        motion[k] = _motion(plant, state)
        if k % often == 0:
            measured = _wheels(plant, motion[k, :2] + missed[k])
        if k % each == 0:
            force[k // each] = driver(k // each, measured)
        right, left = force[k // each]
        advance(plant, state, way, right, left, push[k], round(BEAT / STEP))
    time, seen = np.asarray(np.arange(beats) * BEAT), slice(None, None, odometry)
    twist, pose = motion[seen, :2] + noise[seen], motion[seen, 2:]
    pose = reckoned(time[seen], twist) if how.dead_reckoned else pose
    return Run(name, Commands(time[::each], force), Odometry(time[seen], twist, pose))


def repeat(plant: Plant, run: Run, odometry: float = 50.0) -> Run:
    """Return a run of a plant by the same commands, where nothing disturbs it."""
    rate = 1.0 / (run.commands.time[1] - run.commands.time[0])
    how = Recording(len(run.commands.time) / rate, rate, odometry, 0.0, 0.0)
    return record(plant, lambda k, measured: run.commands.force[k], how, 0)


def remembering(random: np.random.Generator, count: int, forgotten: float) -> Array:
    """Return a first-order random signal of unit rms for each wheel, shape (count, 2)."""
    kept = np.exp(-forgotten)
    shocks = np.sqrt(1.0 - kept**2) * random.normal(size=(count, 2))
    shocks[0] /= np.sqrt(1.0 - kept**2)
    return np.asarray(lfilter([1.0], [1.0, -kept], shocks, axis=0))


def reckoned(time: Array, twist: Array) -> Array:
    """Integrate a twist into a pose by the trapezoidal rule, from zero."""
    step = np.diff(time)[:, None] * 0.5 * (twist[1:] + twist[:-1])
    return reckoned_of(np.vstack([np.zeros(2), step]))


def reckoned_of(steps: Array) -> Array:
    """Add up steps of way and heading into a pose, shape (k, 3), the first one from zero."""
    yaw = np.cumsum(steps[:, 1])
    middle = yaw - 0.5 * steps[:, 1]
    path = np.cumsum(steps[:, :1] * np.column_stack([np.cos(middle), np.sin(middle)]), axis=0)
    return np.column_stack([path, yaw])


def _motion(plant: Plant, state: Array) -> Array:
    """Return v, ω, x, y and yaw."""
    right, left = state[:X]
    return np.array([0.5 * (right + left), 0.5 * (right - left) / plant.half, *state[X : YAW + 1]])


def _wheels(plant: Plant, twist: Array) -> Array:
    return np.asarray(twist[0] + plant.half * twist[1] * np.array([1.0, -1.0]))
