"""Numbers as people write them: as many digits as they deserve, the unit beside."""

from math import floor, isfinite, log10

from diffbot_sim.identification.result import Estimate

DASH = '–'
# An interval that reaches so many times as high as it is low is open above.
OPEN = 1e4


def significant(value: float, digits: int = 3) -> str:
    """Write a number with so many significant digits."""
    if not isfinite(value):
        return DASH
    return _placed(value, digits - 1 - floor(log10(abs(value)))) if value else '0'


def estimate_text(estimate: Estimate) -> str:
    """Write value ± half interval and unit, and whether the fit was stopped by a bound.

    Of a limit that does not show, what it lies above.
    """
    if estimate.at_bound and 0.0 < OPEN * estimate.low < estimate.high:
        return f'above {significant(estimate.low, 2)}{unit_text(estimate.unit)}'
    return _with_interval(estimate) + (' (at bound)' if estimate.at_bound else '')


def _with_interval(estimate: Estimate) -> str:
    """Write value ± half interval and unit, or [low, high] where the interval is lopsided."""
    unit = unit_text(estimate.unit)
    below, above = estimate.value - estimate.low, estimate.high - estimate.value
    if not isfinite(estimate.value):
        return DASH
    if not (isfinite(below + above) and below + above > 0.0):
        return f'{significant(estimate.value, 4)}{unit}{_why_bare(below + above)}'
    spread = (below + above) / 2.0
    decimals = _decimals(spread)
    value = _placed(estimate.value, decimals)
    if abs(above - below) <= 0.3 * spread:
        return f'{value} ± {_placed(spread, decimals)}{unit}'
    low, high = _placed(estimate.low, decimals), _placed(estimate.high, decimals)
    return f'{value} [{low}, {high}]{unit}'


def unit_text(unit: str) -> str:
    """Write a unit with the space before it; nothing for a pure number."""
    return '' if unit in ('', '-') else f' {unit}'


def speed_text(v: float) -> str:
    """Write a speed [m/s] in mm/s."""
    return f'{significant(1e3 * v)} mm/s'


def turn_rate_text(omega: float) -> str:
    """Write a turn rate [rad/s] in mrad/s."""
    return f'{significant(1e3 * omega)} mrad/s'


def _why_bare(width: float) -> str:
    return '' if width == 0.0 else ' (no interval)'


def _decimals(spread: float) -> int:
    """Decimals that show two digits of the spread."""
    return 1 - floor(log10(spread))


def _placed(value: float, decimals: int) -> str:
    """Write a value rounded to so many decimals, with a power of ten where zeros abound."""
    if decimals > 6 or decimals < -4:
        lead = floor(log10(abs(value))) if value else 0
        return f'{value:.{max(0, lead + decimals)}e}'
    return f'{round(value, decimals) + 0.0:.{max(0, decimals)}f}'
