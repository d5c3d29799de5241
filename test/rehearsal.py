"""A drive that was never driven: what a bag would hold, with noise and an uneven floor."""

from dataclasses import dataclass

import numpy as np

from diffbot_sim.drives import GRID, RandomForces
from diffbot_sim.physics import Model, simulate
from diffbot_sim.records import Array, Commands, Odometry, Run


@dataclass(frozen=True)
class Surroundings:
    """What disturbs a drive.

    v_noise [m/s], omega_noise [rad/s]: standard deviations of white odometry noise; roughness
    [N]: that of a force on each wheel from an uneven floor, with a memory of `memory` [s].
    """

    v_noise: float = 0.004
    omega_noise: float = 0.008
    roughness: float = 0.0
    memory: float = 0.3


def random_forces(seed: int, duration: float, least: float, most: float) -> Commands:
    """Return wheel forces between least and most [N], held for random times, with stops."""
    return RandomForces(duration, least, most).commands(seed)


def rehearse(model: Model, commands: Commands, around: Surroundings, seed: int) -> Run:
    """Return what a robot like the model would record, with odometry at the commands' stamps."""
    random = np.random.default_rng(seed)
    force = commands.force + around.roughness * _remembering(random, commands.time, around.memory)
    truth = simulate(model, Commands(commands.time, force), commands.time)
    noise = random.normal(size=(len(commands.time), 2)) * [around.v_noise, around.omega_noise]
    return Run('rehearsal', commands, Odometry(commands.time, truth.twist + noise, truth.pose))


def _remembering(random: np.random.Generator, time: Array, memory: float) -> Array:
    """Return a first-order random force of unit size for each wheel, shape (k, 2)."""
    kept = np.exp(-np.diff(time, prepend=time[0] - 1.0 / GRID) / memory)
    force, shocks = np.zeros((len(time), 2)), random.normal(size=(len(time), 2))
    force[0] = shocks[0]
    for k in range(1, len(time)):
        force[k] = kept[k] * force[k - 1] + np.sqrt(1.0 - kept[k] ** 2) * shocks[k]
    return force
