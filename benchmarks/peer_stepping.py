"""Moreau's time stepping: friction is an inclusion in the velocity at the end of each step.

Wheels and dry yaw friction make a complementarity problem of three small contacts, solved by
projected Gauss–Seidel from the solution of the step before. First order, and friction is not
regularised unless wheels creep: a contact that sticks has a speed of exactly zero.
"""

from math import cos, sin

import numpy as np
from numba import njit
from peer_attached import caster, swinging
from peer_forces import acting, body_force, body_torque, followed, traction, wheel_friction
from peer_plant import Plant
from peer_surroundings import surroundings

from diffbot_sim.records import Array

# Dry friction forward, backward and viscous friction likewise.
Limits = tuple[float, float, float, float]

STEP = 2e-4  # [s]
# The iteration ends after so many sweeps, or when no force changes by more [N].
SWEEPS, SETTLED = 100, 1e-11

# The state: wheel speeds [m/s], pose [m, m, rad], wheel angles [rad], motor forces [N], friction
# of the right wheel, the left one [N] and against turning [N·m], the number of steps made, for how
# long the wheels have been at rest [s], the caster's angle [rad], and how far [m] and how fast
# [m/s] the load has swung.
RIGHT, LEFT, X, Y, YAW, ANGLE_R, ANGLE_L, MOTOR_R, MOTOR_L = range(9)
FRICTION_R, FRICTION_L, SCRUB, COUNT, REST_R, REST_L, CASTER, SWUNG, SWINGING, SIZE = range(9, 19)


def at_rest(p: Plant) -> tuple[Array, Array]:
    """Return a state at rest and the commands [N] under way: one row for each step of delay."""
    return np.zeros(SIZE), np.zeros((round(p.delay / STEP) + 1, 2))


@njit(cache=True)
def advance(
    p: Plant, s: Array, way: Array, right: float, left: float, push: Array, steps: int
) -> None:
    """Move the state on under held commands [N] and pushes on the wheels [N]."""
    for _ in range(steps):
        time, newest = s[COUNT] * STEP, int(s[COUNT]) % len(way)
        way[newest, 0], way[newest, 1] = right, left
        oldest = (newest + 1) % len(way)
        s[MOTOR_R] = followed(p, s[MOTOR_R], acting(p, way[oldest, 0], s[RIGHT]), STEP)
        s[MOTOR_L] = followed(p, s[MOTOR_L], acting(p, way[oldest, 1], s[LEFT]), STEP)
        force_r = push[0] + traction(p, time, s[MOTOR_R], s[ANGLE_R], True)
        force_l = push[1] + traction(p, time, s[MOTOR_L], s[ANGLE_L], False)
        _roll(p, s, time, force_r, force_l)
        s[COUNT] += 1.0


@njit(cache=True)
def _roll(p: Plant, s: Array, time: float, force_r: float, force_l: float) -> None:
    """Find the velocity at the end of a step, and move the pose with the mean velocity."""
    v, omega = 0.5 * (s[RIGHT] + s[LEFT]), 0.5 * (s[RIGHT] - s[LEFT]) / p.half
    loaded = 1.0 if time >= p.load_time else 0.0
    mass = p.mass + loaded * p.load_mass
    inertia = p.inertia + loaded * p.load_inertia + mass * p.ahead**2
    trailing, turning, swivelling = caster(p, s[CASTER], v, omega)
    swung, back = swinging(p, s[SWUNG], s[SWINGING])
    outside = surroundings(p, time, mass, (s[X], s[Y]), s[YAW])
    force = body_force(p, time, mass, v, omega, s[YAW]) + outside
    force += force_r + force_l + trailing + swung
    along = force * STEP / mass
    torque = body_torque(p, mass, v, omega, s[YAW]) + p.half * (force_r - force_l) + turning
    around = p.half * torque * STEP / inertia
    old_r, old_l = s[RIGHT], s[LEFT]
    limits_r = wheel_friction(
        p, time, _wheel_at(s, p.half), s[ANGLE_R], old_r, s[REST_R], force_r, True
    )
    limits_l = wheel_friction(
        p, time, _wheel_at(s, -p.half), s[ANGLE_L], old_l, s[REST_L], force_l, False
    )
    free_r, free_l = old_r + along + around, old_l + along - around
    _stick_or_slide(p, s, (mass, inertia), (limits_r, limits_l), free_r, free_l)
    mean_r, mean_l = 0.5 * (old_r + s[RIGHT]) * STEP, 0.5 * (old_l + s[LEFT]) * STEP
    way, turn = 0.5 * (mean_r + mean_l), 0.5 * (mean_r - mean_l) / p.half
    s[X] += way * cos(s[YAW] + 0.5 * turn)
    s[Y] += way * sin(s[YAW] + 0.5 * turn)
    s[YAW] += turn
    s[ANGLE_R] += mean_r / p.radius
    s[ANGLE_L] += mean_l / p.radius
    s[CASTER] += STEP * swivelling
    s[SWINGING] += STEP * back - 0.5 * (s[RIGHT] - old_r + s[LEFT] - old_l)
    s[SWUNG] += STEP * s[SWINGING]
    s[REST_R] = s[REST_R] + STEP if s[RIGHT] == 0.0 else 0.0
    s[REST_L] = s[REST_L] + STEP if s[LEFT] == 0.0 else 0.0


@njit(cache=True)
def _wheel_at(s: Array, right: float) -> tuple[float, float]:
    """Return where a wheel is [m] that stands so far to the right [m]."""
    return s[X] + right * sin(s[YAW]), s[Y] - right * cos(s[YAW])


@njit(cache=True)
def _stick_or_slide(
    p: Plant,
    s: Array,
    body: tuple[float, float],
    limits: tuple[Limits, Limits],
    free_r: float,
    free_l: float,
) -> None:
    """Put frictions and wheel speeds into the state, from the speeds that none would leave.

    body: mass [kg] and inertia [kg·m²]; limits: of the right and the left wheel.
    """
    mass, inertia = body
    limits_r, limits_l = limits
    own, other = STEP / mass + STEP * p.half**2 / inertia, STEP / mass - STEP * p.half**2 / inertia
    arm, turned = STEP * p.half / inertia, STEP / inertia
    limits_yaw = (p.yaw_dry, p.yaw_dry, p.yaw_viscous, p.yaw_viscous)
    right, left, omega = s[RIGHT], s[LEFT], 0.0
    f_r, f_l, scrub = s[FRICTION_R], s[FRICTION_L], s[SCRUB]
    for _ in range(SWEEPS):
        before_r, before_l, before_scrub = f_r, f_l, scrub
        right, f_r = _contact(free_r - other * f_l - arm * scrub, own, limits_r, p.creep)
        left, f_l = _contact(free_l - other * f_r + arm * scrub, own, limits_l, p.creep)
        unscrubbed = 0.5 * (free_r - free_l) / p.half - arm * (f_r - f_l)
        omega, scrub = _contact(unscrubbed, turned, limits_yaw, 0.0)
        change = max(abs(f_r - before_r), abs(f_l - before_l), abs(scrub - before_scrub))
        if change <= SETTLED:
            break
    if omega == 0.0:
        right = left = 0.0 if right == 0.0 or left == 0.0 else 0.5 * (right + left)
    s[RIGHT], s[LEFT], s[FRICTION_R], s[FRICTION_L], s[SCRUB] = right, left, f_r, f_l, scrub


@njit(cache=True)
def _contact(free: float, compliance: float, limits: Limits, creep: float) -> tuple[float, float]:
    """Return speed and friction of one contact, from its speed without friction.

    compliance: fall of its speed for each unit of its friction; creep: speed up to which dry
    friction grows in a line.
    """
    forward, backward, viscous, back_viscous = limits
    if free > compliance * forward + creep:
        speed = (free - compliance * forward) / (1.0 + compliance * viscous)
        return speed, forward + viscous * speed
    if free < -compliance * backward - creep:
        speed = (free + compliance * backward) / (1.0 + compliance * back_viscous)
        return speed, -backward + back_viscous * speed
    limit = forward if free > 0.0 else backward
    speed = 0.0 if limit == 0.0 else free * creep / (compliance * limit + creep)
    return speed, (free - speed) / compliance
