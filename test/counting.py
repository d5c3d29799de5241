"""A drive, what drivers make of it that count how far wheels turn, and poses added up."""

from dataclasses import replace

import numpy as np
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.physics import Model
from diffbot_sim.records import Array, Odometry, Run

TICK = 1.5e-4  # [m] that a wheel rolls for each count
HALF = Model().robot.half_separation


def driven(model: Model, seed: int = 2) -> Run:
    """Return a drive with white noise on the twist and the true pose, at 50 Hz."""
    return rehearse(model, random_forces(seed, 60.0, -9.0, 11.0), Surroundings(), seed)


def counted(run: Run, over: int) -> Run:
    """Return what a driver makes of encoders: poses of counts, twists as means over intervals."""
    pose, time = run.odometry.pose, run.odometry.time
    step, heading = np.diff(pose, axis=0), 0.5 * (pose[1:, 2] + pose[:-1, 2])
    way = np.cumsum(step[:, 0] * np.cos(heading) + step[:, 1] * np.sin(heading))
    turn = pose[1:, 2] - pose[0, 2]
    counts = np.floor(np.column_stack([way + HALF * turn, way - HALF * turn]) / TICK) * TICK
    path = np.column_stack([counts.mean(axis=1), counts @ [0.5, -0.5] / HALF])
    moved, middle = np.diff(path, axis=0), 0.5 * (path[1:, 1] + path[:-1, 1])
    where = np.cumsum(moved[:, :1] * np.column_stack([np.cos(middle), np.sin(middle)]), axis=0)
    poses = np.column_stack([where, path[1:, 1]])[over - 1 :]
    twist = (path[over:] - path[:-over]) / (time[over + 1 :] - time[1:-over])[:, None]
    return replace(run, odometry=Odometry(time[over + 1 :], twist, poses))


def posed(run: Run, moved: Array) -> Run:
    """Return a run whose poses are its ways and turns between samples, (k - 1, 2), added up."""
    first = run.odometry.pose[:1]
    heading = first[0, 2] + np.concatenate([[0.0], np.cumsum(moved[:, 1])])
    middle = 0.5 * (heading[1:] + heading[:-1])
    steps = moved[:, :1] * np.column_stack([np.cos(middle), np.sin(middle)])
    where = np.concatenate([first[:, :2], first[:, :2] + np.cumsum(steps, axis=0)])
    return replace(run, odometry=replace(run.odometry, pose=np.column_stack([where, heading])))


def at_both_ends(odometry: Odometry) -> Array:
    """Return ways and turns as the twists at both ends of each step make them."""
    return 0.5 * (odometry.twist[1:] + odometry.twist[:-1]) * np.diff(odometry.time)[:, None]
