"""What drives the peer plant: wheel forces drawn at random, or wheel speeds under a PI law."""

from collections.abc import Callable

import numpy as np
from peer_robots import Make

from diffbot_sim.records import Array

# Asked at every command, with the number of the command and the measured wheel speeds [m/s].
Driver = Callable[[int, Array], Array]

STANDING = 1.0  # before a drive begins, for the recorder [s]
SHORTEST, LONGEST = 0.5, 2.5  # time for which a goal is held [s]
KINDS = {'arc': 0.4, 'straight': 0.25, 'spin': 0.2, 'stop': 0.15}
RISE = 0.25  # time in which the PI law closes half an error, roughly [s]


def random_forces(make: Make, seed: int, duration: float, rate: float) -> Driver:
    """Return held forces, forward more than backward, with stops, at a command rate [Hz]."""

    def goal(random: np.random.Generator) -> Array:
        forward, turn = random.uniform(-0.7, 0.8), random.uniform(-0.4, 0.4)
        return np.asarray(make.push * np.array(_wheels(random, forward, turn)))

    table = _held(seed, duration, rate, goal)
    return lambda k, measured: np.asarray(table[k])


def closed_loop(make: Make, seed: int, duration: float, rate: float) -> Driver:
    """Return a PI law on each wheel's speed that follows random twists, at a rate [Hz]."""

    def goal(random: np.random.Generator) -> Array:
        v, omega = random.uniform(-1.0, 1.0, 2) * [make.fastest, make.fastest_turn]
        return np.array(_wheels(random, v, make.plant.half * omega))

    return following(make, _held(seed, duration, rate, goal), rate)


def following(make: Make, goals: Array, rate: float) -> Driver:
    """Return a PI law that follows wheel speeds [m/s], one pair a command, shape (k, 2)."""
    kp = 0.5 * make.plant.mass / RISE
    ki, total = kp / (2.0 * RISE), np.zeros(2)

    def drive(k: int, measured: Array) -> Array:
        error = goals[k] - measured
        wanted = kp * error + ki * total
        total[abs(wanted) < make.push] += (error / rate)[abs(wanted) < make.push]
        return np.asarray(np.clip(wanted, -make.push, make.push))

    return drive


DRIVES = {'forces': random_forces, 'loop': closed_loop}


def _wheels(random: np.random.Generator, forward: float, turn: float) -> tuple[float, float]:
    """Draw a kind of motion, and return its share for the right and the left wheel."""
    kind = random.choice(list(KINDS), p=list(KINDS.values()))
    moves = forward * (kind in ('arc', 'straight'))
    turns = turn * (kind in ('arc', 'spin')) * (0.4 if kind == 'arc' else 1.0)
    return moves + turns, moves - turns


def _held(
    seed: int, duration: float, rate: float, goal: Callable[[np.random.Generator], Array]
) -> Array:
    """Return goals for every command, each held for a random time."""
    random, begin = np.random.default_rng([seed, 2]), round(STANDING * rate)
    table = np.zeros((round(duration * rate), 2))
    while begin < len(table):
        end = begin + round(random.uniform(SHORTEST, LONGEST) * rate)
        table[begin:end] = goal(random)
        begin = end
    return table
