"""At which periods of time or wheel angle a residual repeats: cheap, before any simulation."""

from math import exp

import numpy as np

from diffbot_sim.identification.fitting import Fit
from diffbot_sim.identification.views import views
from diffbot_sim.records import Array

# Orders [cycles per revolution] that are looked at, and how many of the strongest are kept.
LOWEST, HIGHEST, KEPT = 0.2, 60.0, 4
# Cycles per second that are looked at, and cycles in the longest run below which none is.
HIGHEST_RATE, FEWEST_CYCLES = 5.0, 4.0
# Points per line width of the spectrum; samples that a cycle needs at the usual speed.
FINENESS, SAMPLES_PER_CYCLE = 3.0, 3.0
# Points to which errors are moved, in the shortest wave: it loses a hundredth of its power.
POINTS_PER_CYCLE = 32.0
# Beside a peak, this many line widths are its side lobes; so many times as far reaches the floor
# out of which a line must stand, so seldom by chance, and of so many points at least it is known.
SIDE_LOBES, FLOOR, FEWEST_POINTS = 5.0, 10.0, 20
LINE_LEVEL = 1e-3
# Median of the squared amplitude of two columns of noise, over the mean of one.
MEDIAN = 1.678


def wheel_orders(fit: Fit) -> tuple[float, ...]:
    """Return the cycles per wheel revolution at which the innovations are strongest."""
    angles, errors = _by_wheel(fit)
    moving = np.abs(np.diff(angles, axis=0, prepend=angles[:1])) > 0.0
    weights = np.where(moving, errors, 0.0)
    steps = np.abs(np.diff(angles, axis=0))
    usual = float(np.median(steps[steps > 0.0])) if np.any(steps > 0.0) else 0.0
    if usual == 0.0:
        return ()
    spacing = 2.0 * np.pi / (FINENESS * float(np.ptp(angles, axis=0).max()))
    highest = min(HIGHEST, 2.0 * np.pi / (SAMPLES_PER_CYCLE * usual))
    orders = np.arange(LOWEST, highest, max(spacing, 1e-4))
    return _strongest(orders, angles, weights, spacing)


def rates(fit: Fit) -> tuple[float, ...]:
    """Return the cycles per second at which the innovations are strongest."""
    time = np.concatenate([stretch.time for stretch in fit.stretches])
    errors = np.concatenate([v.innovation / fit.sigma for v in views(fit, fit.stretches)])
    spacing = 1.0 / (FINENESS * max(float(np.ptp(s.time)) for s in fit.stretches))
    interval = max(stretch.interval for stretch in fit.stretches)
    highest = min(HIGHEST_RATE, 1.0 / (SAMPLES_PER_CYCLE * interval))
    # Slower than this it would be a drift.
    cycles = np.arange(FEWEST_CYCLES * FINENESS * spacing, highest, spacing)
    turns = np.repeat(2.0 * np.pi * time[:, None], 2, axis=1)
    return _strongest(cycles, turns, errors, spacing)


def _by_wheel(fit: Fit) -> tuple[Array, Array]:
    """Return wheel angles [rad] and the wheels' share of the innovations, columns right, left."""
    seen = views(fit, fit.stretches)
    angles, errors = zip(*((v.wheel_angle, v.innovation @ v.mix) for v in seen), strict=True)
    return np.concatenate(angles), np.concatenate(errors)


def _strongest(orders: Array, angles: Array, errors: Array, spacing: float) -> tuple[float, ...]:
    """Return the orders whose waves are strongest in the errors, if they stand out of others.

    spacing: of a fine spectrum. Errors that depend on the angle or on time anyhow, not in waves,
    have as much power all around.
    """
    if len(orders) < 3:
        return ()
    return _peaks(orders, _power(orders, angles, errors), SIDE_LOBES * FINENESS * spacing)


def _power(orders: Array, angles: Array, errors: Array) -> Array:
    """Return the squared amplitude at each of evenly spaced orders, both columns together.

    By a fast transform of errors that are shared among points, far closer than any wave is long.
    """
    spacing = orders[1] - orders[0]
    count = int(POINTS_PER_CYCLE * orders[-1] / spacing)
    places = angles * (spacing * count / (2.0 * np.pi))
    points, offset = np.floor(places).astype(int), errors * np.exp(-1j * orders[0] * angles)
    gathered = np.zeros((count, angles.shape[1]), complex)
    for at, share in ((points, 1.0 + points - places), (points + 1, places - points)):
        np.add.at(gathered, (at % count, np.arange(angles.shape[1])), share * offset)
    waves = np.fft.fft(gathered, axis=0)[: len(orders)]
    return np.asarray(np.sum(np.abs(waves) ** 2, axis=1))


def _peaks(orders: Array, power: Array, apart: float) -> tuple[float, ...]:
    """Return the orders of the highest local maxima, the highest first, side lobes left out."""
    inner = (power[1:-1] >= power[:-2]) & (power[1:-1] >= power[2:])
    places = 1 + np.flatnonzero(inner)
    kept: list[float] = []
    for place in places[np.argsort(power[places])[::-1]]:
        order = float(orders[place] + (orders[1] - orders[0]) * _summit(power[place - 1 :][:3]))
        if all(abs(order - other) > apart for other in kept):
            kept.append(order)
    return tuple(order for order in kept[:KEPT] if _stands_out(order, orders, power, apart))


def _stands_out(order: float, orders: Array, power: Array, apart: float) -> bool:
    """Say whether noise with the floor around an order would hardly be as strong anywhere."""
    distance = np.abs(orders - order)
    around = power[(distance > apart) & (distance < FLOOR * apart)]
    if len(around) < FEWEST_POINTS:
        return True
    height = float(power[distance <= orders[1] - orders[0]].max() * MEDIAN / np.median(around))
    return (1.0 + height) * exp(-height) * len(orders) / FINENESS < LINE_LEVEL


def _summit(power: Array) -> float:
    """Return where between -1 and 1 the parabola through three logarithms is highest."""
    left, middle, right = np.log(np.maximum(power, 1e-300))
    bend = left - 2.0 * middle + right
    return float(0.5 * (left - right) / bend) if bend < 0.0 else 0.0
