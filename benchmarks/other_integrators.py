"""Three other ways to step two wheels with friction (13): what our integrator is compared with.

tanh regularisation and a Karnopp band put another friction law in place of the set-valued one
and integrate it by fourth-order Runge-Kutta; backward Euler keeps the set-valued law.
"""

from collections.abc import Callable
from math import cos, exp, sin, tanh
from typing import Any, NamedTuple

import numpy as np
from numba import njit

from diffbot_sim.physics import Model
from diffbot_sim.records import Array

Pair = tuple[float, float]
SWEEPS = 30  # over the wheels, until what they feel of each other agrees to the last bits
NEWTON = 6  # iterations for the speed of a wheel that rolls


class Plant(NamedTuple):
    """A, B [1/kg], b [m], and the friction of each wheel: F_s, F_k [N], F_v [N·s/m], a [s/m]."""

    own: float
    other: float
    half_separation: float
    static: float
    coulomb: float
    viscous: float
    stribeck: float


class Motion(NamedTuple):
    """Position, then travel and speed of the right and left wheel [m, m/s]; also their rates."""

    x: float
    y: float
    travel_right: float
    travel_left: float
    right: float
    left: float


def drive(
    step: Callable[..., Motion],
    width: float,
    model: Model,
    forces: Array,
    interval: float,
    duration: float,
) -> Array:
    """Step from rest; return x, y and the wheels' travel [m] at every change of force.

    forces [N], shape (n, 2), each held for an interval [s] of steps of the given duration [s].
    """
    robot, law = model.robot, model.friction.law()
    linear, angular = 1.0 / robot.mass, robot.half_separation**2 / robot.inertia
    static = law.coulomb + law.excess
    friction = static, law.coulomb, law.viscous, law.stribeck
    plant = Plant(linear + angular, linear - angular, robot.half_separation, *friction)
    rows = np.zeros((len(forces) + 1, 4))
    _drive(step, plant, width, forces, round(interval / duration), duration, rows)
    return rows


@njit
def _drive(
    step: Any, plant: Plant, width: float, forces: Array, count: int, h: float, rows: Array
) -> None:
    z = Motion(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    for i in range(len(forces)):
        force = (forces[i, 0], forces[i, 1])
        for _ in range(count):
            z = step(plant, width, force, z, h)
        rows[i + 1] = z[:4]


@njit
def tanh_step(plant: Plant, width: float, force: Pair, z: Motion, h: float) -> Motion:
    """Step with tanh(v / width) in place of the sign of v."""
    return _runge_kutta(_regularised, plant, width, force, z, h)


@njit
def karnopp_step(plant: Plant, width: float, force: Pair, z: Motion, h: float) -> Motion:
    """Step with wheels slower than the width held still, as far as F_s allows."""
    end = _runge_kutta(_banded, plant, width, force, z, h)
    friction = _banded(plant, width, force, end)
    before = (z.travel_right, z.right), (z.travel_left, z.left)
    after = (end.travel_right, end.right), (end.travel_left, end.left)
    right = _settled(plant, width, friction[0], before[0], after[0])
    left = _settled(plant, width, friction[1], before[1], after[1])
    return Motion(end.x, end.y, right[0], left[0], right[1], left[1])


@njit
def _settled(plant: Plant, width: float, friction: float, before: Pair, after: Pair) -> Pair:
    """Return travel and speed of a wheel: it rests where it is slow and friction suffices."""
    if abs(after[1]) > width or abs(friction) >= plant.static:
        return after
    return before[0] if before[1] == 0.0 else after[0], 0.0


@njit
def backward_euler_step(plant: Plant, _: float, force: Pair, z: Motion, h: float) -> Motion:
    """Step with the friction that belongs to the speeds at the end, a set at speed 0."""
    gain, passed = plant.own * h, plant.other * h
    right, left, friction_right, friction_left = 0.0, 0.0, 0.0, 0.0
    for _sweep in range(SWEEPS):
        before = friction_left
        free = z.right + gain * force[0] + passed * (force[1] - friction_left)
        right, friction_right = _implicit(plant, gain, free)
        free = z.left + gain * force[1] + passed * (force[0] - friction_right)
        left, friction_left = _implicit(plant, gain, free)
        if friction_left == before:
            break
    travel = z.travel_right + h * right, z.travel_left + h * left
    v, heading = 0.5 * (right + left), (travel[0] - travel[1]) / (2.0 * plant.half_separation)
    return Motion(z.x + h * v * cos(heading), z.y + h * v * sin(heading), *travel, right, left)


@njit
def _implicit(plant: Plant, gain: float, free: float) -> Pair:
    """Return speed and friction of a wheel; free: its speed [m/s] if there were no friction.

    Newton's method from above converges: the speed that friction leaves is convex.
    """
    if abs(free) <= gain * plant.static:
        return 0.0, free / gain
    speed = abs(free)
    for _ in range(NEWTON):
        drop = (plant.static - plant.coulomb) * exp(-plant.stribeck * speed)
        excess = speed + gain * (plant.coulomb + drop + plant.viscous * speed) - abs(free)
        speed -= excess / (1.0 + gain * (plant.viscous - plant.stribeck * drop))
    sign = 1.0 if free > 0.0 else -1.0
    return sign * speed, (free - sign * speed) / gain


@njit
def _regularised(plant: Plant, width: float, _: Pair, z: Motion) -> Pair:
    right = _rolling(plant, tanh(z.right / width), z.right)
    return right, _rolling(plant, tanh(z.left / width), z.left)


@njit
def _banded(plant: Plant, width: float, force: Pair, z: Motion) -> Pair:
    """Return what holds a slow wheel, up to F_s; the force on the other one reaches it too."""
    right = _rolling(plant, np.sign(z.right), z.right)
    left = _rolling(plant, np.sign(z.left), z.left)
    slow_right, slow_left = abs(z.right) <= width, abs(z.left) <= width
    passed = plant.other / plant.own
    left = _held(plant, force[1]) if slow_left else left
    for _ in range(SWEEPS if slow_right and slow_left else 1):
        right = _held(plant, force[0] + passed * (force[1] - left)) if slow_right else right
        left = _held(plant, force[1] + passed * (force[0] - right)) if slow_left else left
    return right, left


@njit
def _rolling(plant: Plant, sign: float, speed: float) -> float:
    drop = (plant.static - plant.coulomb) * exp(-plant.stribeck * abs(speed))
    return sign * (plant.coulomb + drop) + plant.viscous * speed


@njit
def _held(plant: Plant, force: float) -> float:
    return min(max(force, -plant.static), plant.static)


@njit
def _runge_kutta(law: Any, plant: Plant, width: float, force: Pair, z: Motion, h: float) -> Motion:
    k1 = _rate(law, plant, width, force, z)
    k2 = _rate(law, plant, width, force, _moved(z, k1, 0.5 * h))
    k3 = _rate(law, plant, width, force, _moved(z, k2, 0.5 * h))
    k4 = _rate(law, plant, width, force, _moved(z, k3, h))
    z = _moved(_moved(z, k1, h / 6.0), k2, h / 3.0)
    return _moved(_moved(z, k3, h / 3.0), k4, h / 6.0)


@njit
def _rate(law: Any, plant: Plant, width: float, force: Pair, z: Motion) -> Motion:
    right, left = law(plant, width, force, z)
    net_right, net_left = force[0] - right, force[1] - left
    turned = z.travel_right - z.travel_left
    v, heading = 0.5 * (z.right + z.left), turned / (2.0 * plant.half_separation)
    return Motion(
        v * cos(heading),
        v * sin(heading),
        z.right,
        z.left,
        plant.own * net_right + plant.other * net_left,
        plant.other * net_right + plant.own * net_left,
    )


@njit
def _moved(z: Motion, rate: Motion, h: float) -> Motion:
    return Motion(
        z.x + h * rate.x,
        z.y + h * rate.y,
        z.travel_right + h * rate.travel_right,
        z.travel_left + h * rate.travel_left,
        z.right + h * rate.right,
        z.left + h * rate.left,
    )
