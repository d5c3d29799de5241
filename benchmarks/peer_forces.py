"""Forces of the peer plant: from commands to wheels, on the body, and the limits of friction."""

from math import copysign, cos, exp, floor, hypot, log, pi, sin

from numba import njit
from peer_plant import Plant

GRAVITY = 9.81
# A wheel that rests for less than this hardly settles [s].
SETTLES = 0.5
# How long a shove lasts [s], and how many times as late the next one comes.
SHOVE, LATER = 0.8, 1.6


@njit(cache=True)
def acting(p: Plant, command: float, speed: float) -> float:
    """Return the force [N] that a motor aims at: in steps, less the dead band, then limited.

    speed: of the wheel [m/s].
    """
    if p.coarse != 0.0:
        command = p.coarse * round(command / p.coarse)
    size = max(abs(command) - p.deadband, 0.0)
    driving = max(copysign(speed, command * speed), 0.0)
    size = min(size, p.saturation, p.stall * max(1.0 - driving / p.no_load, 0.0))
    if size * driving > p.power:
        size = p.power / driving
    return copysign(size, command)


@njit(cache=True)
def followed(p: Plant, motor: float, aim: float, step: float) -> float:
    """Return a motor's force [N] a step [s] later: it lags, and changes only so fast."""
    most = p.slew * step
    return motor + min(max((aim - motor) * step / (p.lag + step), -most), most)


@njit(cache=True)
def traction(p: Plant, time: float, motor: float, angle: float, right: bool) -> float:
    """Return what drives a wheel [N], from its motor's force [N] and its angle [rad]."""
    gain = p.gain_right if right else p.gain_left
    force = gain * (1.0 - p.fade * time) * exp(-p.decay * time) * motor
    force *= 1.0 - p.slip * (force / p.slip_force) ** 2
    ripple, phase = (p.ripple_right, p.phase_right) if right else (p.ripple_left, p.phase_left)
    bias = p.bias_right if right else p.bias_left
    return force + bias + ripple * sin(p.ripple_order * angle + phase)


@njit(cache=True)
def body_force(p: Plant, time: float, mass: float, v: float, omega: float, yaw: float) -> float:
    """Return what pushes the body forward [N], wheels aside, seen from the axle's middle."""
    uphill = p.rise_x * cos(yaw) + p.rise_y * sin(yaw)
    force = mass * p.ahead * omega**2 - p.drag * v * abs(v) - mass * GRAVITY * uphill
    force += p.sway * sin(2.0 * pi * p.sway_rate * time)
    if time % p.knock_period < p.knock_time:
        force += p.knock
    if p.shove != 0.0 and time >= p.shove_first:
        count = floor(log(time / p.shove_first) / log(LATER))
        if time - p.shove_first * LATER**count < SHOVE:
            force += p.shove * (-1.0) ** count
    if p.bump != 0.0 and v != 0.0:
        near = (abs(v) - p.bump_speed) / p.bump_width
        force -= copysign(p.bump * exp(-(near**2)), v)
    return force


@njit(cache=True)
def body_torque(p: Plant, mass: float, v: float, omega: float, yaw: float) -> float:
    """Return what turns the body about the axle's middle [N·m], wheels aside."""
    sideways = p.rise_y * cos(yaw) - p.rise_x * sin(yaw)
    return -mass * p.ahead * (v * omega + GRAVITY * sideways)


@njit(cache=True)
def wheel_friction(
    p: Plant,
    time: float,
    place: tuple[float, float],
    angle: float,
    speed: float,
    rest: float,
    force: float,
    right: bool,
) -> tuple[float, float, float, float]:
    """Return dry friction [N] forward, backward and viscous friction [N·s/m] likewise.

    place: of the wheel [m]; angle: how far it has turned [rad]; rest: for how long it has been at
    rest [s]; force: what drives it [N].
    """
    aged = 1.0 + p.warming * (1.0 - exp(-time / p.warm_time)) + p.wear * time
    if time >= p.load_time:
        aged *= 1.0 + p.load_friction
    if time >= p.carpet_time:
        aged *= 1.0 + p.carpet
    dry = aged * (p.coulomb + (p.static - p.coulomb) * exp(-p.stribeck * abs(speed)))
    dry += p.settling * log(1.0 + rest / SETTLES) + p.gear * abs(force)
    if p.tight != 0.0:
        rubs = p.tight_right if right else p.tight_left
        dry *= 1.0 + p.tight * max(cos(angle - rubs), 0.0) ** 3
    if hypot(place[0] - p.puddle_x, place[1] - p.puddle_y) < p.puddle_radius:
        dry *= 1.0 + p.puddle
    viscous = aged * p.viscous
    if not right:
        dry *= 1.0 + p.left_dry
        viscous *= 1.0 + p.left_viscous
    rough = p.patch if sin(pi * place[0] / p.patch_width) > 0.0 else 0.0
    back, back_viscous = dry * (1.0 + p.backward_dry), viscous * (1.0 + p.backward_viscous)
    return dry + rough, back + rough, viscous, back_viscous
