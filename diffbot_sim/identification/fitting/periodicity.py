"""At which periods of time or wheel angle a residual repeats: cheap, before any simulation."""

from collections.abc import Sequence
from math import ceil

import numpy as np
from scipy.special import gammainccinv

from diffbot_sim.identification.fitting.views import View
from diffbot_sim.records import Array

# Orders [cycles per revolution] that are looked at, and how many of the strongest are kept.
LOWEST, HIGHEST, KEPT = 0.2, 60.0, 4
# Cycles per second that are looked at, and cycles in the longest run below which none is.
HIGHEST_RATE, FEWEST_CYCLES = 5.0, 4.0
# Harmonics of something that comes again and again, as a short push does.
TEETH = 4
# Steps between the least and the largest command that are looked for at most, and how many
# commands that takes: a few that lie evenly look like steps.
MOST_STEPS, FEWEST_FORCES = 300.0, 30
# Points per line width of the spectrum; samples that a cycle needs at the usual speed.
FINENESS, SAMPLES_PER_CYCLE = 3.0, 3.0
# Points to which errors are moved, in the shortest wave: it loses a hundredth of its power.
POINTS_PER_CYCLE = 32.0
# Beside a peak, this many line widths are its side lobes; the floor out of which a line must
# stand, so seldom by chance, is the median over so many.
SIDE_LOBES, FLOOR = 5.0, 100.0
LINE_LEVEL = 1e-3
# The same for steps: a force that is held is told by few errors, and no floor repeats with it.
STEP_LEVEL = 0.05
# Where errors are all zero.
TINY = 1e-300
# Median of the squared amplitude of two columns of noise, over the mean of one.
MEDIAN = 1.678


def wheel_orders(seen: Sequence[View]) -> tuple[float, ...]:
    """Return the cycles per wheel revolution at which the innovations are strongest."""
    return _orders(seen, np.abs(_senses(seen)), 1)


def rubbing_orders(seen: Sequence[View], teeth: int) -> tuple[float, ...]:
    """Return those at which innovations against the motion are strongest.

    teeth: harmonics that are taken together.
    """
    return _orders(seen, _senses(seen), teeth)


def _senses(seen: Sequence[View]) -> Array:
    """Return in which sense each wheel turned before a sample: 1, -1, or 0 where it rested."""
    # What counts of a stretch begins later than its first sample.
    speeds = [np.roll(view.wheel_speed, 1, axis=0) for view in seen]
    return np.sign(np.concatenate(speeds))


def _orders(seen: Sequence[View], senses: Array, teeth: int) -> tuple[float, ...]:
    angles, errors = _by_wheel(seen)
    steps = np.abs(np.diff(angles, axis=0))[senses[1:] != 0.0]
    usual = float(np.median(steps)) if len(steps) > 0 else 0.0
    if usual == 0.0:
        return ()
    spacing = 2.0 * np.pi / (FINENESS * float(np.ptp(angles, axis=0).max()))
    highest = min(HIGHEST, 2.0 * np.pi / (SAMPLES_PER_CYCLE * usual))
    return _strongest((LOWEST, highest), max(spacing, 1e-4), angles, senses * errors, teeth)


def rates(seen: Sequence[View]) -> tuple[float, ...]:
    """Return the cycles per second at which the innovations are strongest."""
    return _rates(seen, _whitened(seen), 1)


def repeats(seen: Sequence[View]) -> tuple[float, ...]:
    """Return the cycles per second of which several harmonics together are strongest."""
    return _rates(seen, _whitened(seen), TEETH)


def gain_rates(seen: Sequence[View]) -> tuple[float, ...]:
    """Return those at which innovations in proportion to the commanded forces are strongest."""
    _, errors = _by_wheel(seen)
    return _rates(seen, errors * np.concatenate([view.force for view in seen]), 1)


def force_rates(seen: Sequence[View]) -> tuple[float, ...]:
    """Return the cycles per newton of commanded force at which the innovations are strongest."""
    force = np.concatenate([view.force for view in seen])
    if len(np.unique(force)) < FEWEST_FORCES:
        return ()
    errors = np.concatenate([view.innovation @ view.mix for view in seen])
    spacing = 1.0 / (FINENESS * float(np.ptp(force)))
    band = FEWEST_CYCLES * FINENESS * spacing, MOST_STEPS * FINENESS * spacing
    return _strongest(band, spacing, 2.0 * np.pi * force, errors, level=STEP_LEVEL)


def _whitened(seen: Sequence[View]) -> Array:
    """Return innovations over their scale."""
    return np.concatenate([view.innovation / view.fit.sigma for view in seen])


def _rates(seen: Sequence[View], errors: Array, teeth: int) -> tuple[float, ...]:
    time = np.concatenate([view.stretch.time for view in seen])
    spacing = 1.0 / (FINENESS * max(float(np.ptp(view.stretch.time)) for view in seen))
    interval = max(view.stretch.interval for view in seen)
    highest = min(HIGHEST_RATE, 1.0 / (SAMPLES_PER_CYCLE * interval))
    # Slower than this it would be a drift.
    lowest = FEWEST_CYCLES * FINENESS * spacing
    turns = np.repeat(2.0 * np.pi * time[:, None], 2, axis=1)
    return _strongest((lowest, highest), spacing, turns, errors, teeth)


def _by_wheel(seen: Sequence[View]) -> tuple[Array, Array]:
    """Return wheel angles [rad] and the wheels' share of the innovations, columns right, left."""
    angles, errors = zip(*((v.wheel_angle, v.innovation @ v.mix) for v in seen), strict=True)
    return np.concatenate(angles), np.concatenate(errors)


def _strongest(
    band: tuple[float, float],
    spacing: float,
    angles: Array,
    errors: Array,
    teeth: int = 1,
    level: float = LINE_LEVEL,
) -> tuple[float, ...]:
    """Return the orders in a band whose waves are strongest in the errors, if they stand out.

    spacing: of a fine spectrum; teeth: harmonics that are taken together; level: how seldom noise
    may be as strong. Errors that depend on the angle or on time anyhow, not in waves, have as much
    power all around.
    """
    step = spacing / teeth
    first, end = ceil(band[0] / step), ceil(band[1] / step)
    fundamentals = np.arange(first, (end - 1) // teeth + 1)
    if len(fundamentals) < 3:
        return ()
    orders = np.asarray(step * np.arange(first, end), float)
    power = _power(orders, angles, errors)
    heights = MEDIAN * power / _floor(power, FLOOR * FINENESS * teeth)
    comb: Array = np.sum([heights[h * fundamentals - first] for h in range(1, teeth + 1)], axis=0)
    least = float(gammainccinv(2 * teeth, level * FINENESS / len(fundamentals)))
    return _peaks(orders[: len(fundamentals)], comb, least, SIDE_LOBES * FINENESS * spacing)


def _floor(power: Array, width: float) -> Array:
    """Return the median of a spectrum around each of its points; width: how many these are."""
    parts = np.array_split(np.arange(len(power)), max(1, round(len(power) / width)))
    medians = [max(float(np.median(power[part])), TINY) for part in parts]
    return np.interp(np.arange(len(power)), [part.mean() for part in parts], medians)


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


def _peaks(orders: Array, height: Array, least: float, apart: float) -> tuple[float, ...]:
    """Return the orders of the highest local maxima, the highest first, side lobes left out."""
    inner = (height[1:-1] >= height[:-2]) & (height[1:-1] >= height[2:]) & (height[1:-1] > least)
    places = 1 + np.flatnonzero(inner)
    kept: list[float] = []
    for place in places[np.argsort(height[places])[::-1]]:
        order = float(orders[place] + (orders[1] - orders[0]) * _summit(height[place - 1 :][:3]))
        if all(abs(order - other) > apart for other in kept):
            kept.append(order)
    return tuple(kept[:KEPT])


def _summit(power: Array) -> float:
    """Return where between -1 and 1 the parabola through three logarithms is highest."""
    left, middle, right = np.log(np.maximum(power, TINY))
    bend = left - 2.0 * middle + right
    return float(0.5 * (left - right) / bend) if bend < 0.0 else 0.0
