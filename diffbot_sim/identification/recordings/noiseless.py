"""Recordings without noise: told again as a good odometry would have told them.

Where a simulator, or a laboratory, leaves no noise, what two integrators differ by is beyond all
chance, and small as it is, names and structure come up for it that say nothing of a robot.
"""

from dataclasses import replace
from math import sqrt
from zlib import crc32

import numpy as np

from diffbot_sim.identification.recordings.stretches import thin
from diffbot_sim.identification.result import ErrorNorm
from diffbot_sim.records import Array, Run

# Noise of each wheel's speed that a good odometry has [m/s].
WHEEL_NOISE = 0.004
# What has less than this share of it is told by no odometry.
NOISELESS = 0.2


def odometry_noise(half_separation: float) -> Array:
    """Return the noise of v [m/s] and ω [rad/s] that a good odometry has, shape (2,)."""
    each = WHEEL_NOISE / sqrt(2.0)
    return np.array([each, each / half_separation])


def is_noiseless(floor: ErrorNorm, noise: Array) -> bool:
    """Say whether what a perfect model would leave is too little for any odometry's noise (2,)."""
    return bool(np.all(floor.pair < NOISELESS * noise))


def with_noise(run: Run, noise: Array) -> Run:
    """Return a run with so much white noise on its twists, the same whenever it is asked for."""
    run = thin(run)
    seen = run.odometry
    chance = np.random.default_rng(crc32(np.ascontiguousarray(seen.twist).tobytes()))
    twist = seen.twist + noise * chance.standard_normal(seen.twist.shape)
    return replace(run, odometry=replace(seen, twist=twist))
