"""Drives unlike the random ones: what people do with a robot, by plan or by hand.

Most show less than a recommended drive: a figure of eight never turns a wheel back.
"""

import numpy as np
from peer_drives import STANDING, Driver, following
from peer_robots import Make

from diffbot_sim.records import Array

# Shares of the greatest force and frequencies [Hz] of a sum of sines.
SINES = ((0.45, 0.07), (0.35, 0.19), (0.25, 0.43), (0.15, 1.1))
# Stairs: forces in turn, each with one of the differences between the wheels, in shares of the
# greatest force; each is held for STEP [s].
STEPS, DIFFERENCES, STEP = (0.0, 0.25, 0.5, 0.75, -0.25, -0.5, 0.4), (0.0, 0.15, -0.15), 3.0
# Keys that a hand likes to hold: forward and turning, in shares of KEYBOARD of the fastest.
KEYS = ((1, 0), (1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 0), (0, 0))
KEYBOARD, HELD = (0.5, 0.45), (0.5, 4.0)


def sines(make: Make, seed: int, duration: float, rate: float) -> Driver:
    """Return wheel forces that are sums of sines."""
    random, time = np.random.default_rng([seed, 5]), _stamps(duration, rate)
    waves = [
        share * np.sin(2.0 * np.pi * often * time[:, None] + random.uniform(0.0, 2.0 * np.pi, 2))
        for share, often in SINES
    ]
    table = make.push * np.clip(np.sum(waves, axis=0), -1.0, 1.0) * _moving(time)
    return lambda k, measured: np.asarray(table[k])


def eights(make: Make, seed: int, duration: float, rate: float) -> Driver:
    """Return figures of eight under a PI law; no wheel stops or turns back."""
    time = _stamps(duration, rate) + seed
    v = make.fastest * (0.55 + 0.3 * np.sin(2.0 * np.pi * time / 13.0))
    omega = 0.7 * make.fastest_turn * np.sin(2.0 * np.pi * time / 9.0)
    return following(make, _of_wheels(make, v, omega) * _moving(time - seed), rate)


def stairs(make: Make, seed: int, duration: float, rate: float) -> Driver:
    """Return wheel forces in steps, each held until the robot hardly gets faster."""
    time = _stamps(duration, rate)
    step = np.maximum((time - STANDING) // STEP, 0.0).astype(int) + seed
    force = np.take(STEPS, step % len(STEPS))
    apart = np.take(DIFFERENCES, step % len(DIFFERENCES))
    table = make.push * np.column_stack([force + apart, force - apart]) * _moving(time)
    return lambda k, measured: np.asarray(table[k])


def keyboard(make: Make, seed: int, duration: float, rate: float) -> Driver:
    """Return the twists of a keyboard, full or nothing, under a PI law."""
    random, time = np.random.default_rng([seed, 6]), _stamps(duration, rate)
    twist, begin = np.zeros((len(time), 2)), round(STANDING * rate)
    while begin < len(time):
        end = begin + round(random.uniform(*HELD) * rate)
        twist[begin:end] = random.choice(KEYS) * np.array(KEYBOARD)
        begin = end
    v, omega = (twist * [make.fastest, make.fastest_turn]).T
    return following(make, _of_wheels(make, v, omega), rate)


MANOEUVRES = {'sines': sines, 'eights': eights, 'stairs': stairs, 'keyboard': keyboard}


def _stamps(duration: float, rate: float) -> Array:
    return np.arange(round(duration * rate)) / rate


def _moving(time: Array) -> Array:
    """Return 0 while the robot stands for the recorder, then 1, shape (k, 1)."""
    return np.asarray((time > STANDING)[:, None].astype(float))


def _of_wheels(make: Make, v: Array, omega: Array) -> Array:
    return np.column_stack([v + make.plant.half * omega, v - make.plant.half * omega])
