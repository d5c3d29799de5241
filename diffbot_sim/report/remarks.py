"""Remarks: what was not taken as it was recorded or declared, and why, in words."""

from math import log, sqrt

from diffbot_sim.identification.result import ErrorNorm, Identification, Timing
from diffbot_sim.report.numerals import significant, speed_text, turn_rate_text

TIMINGS = {
    'pose': 'the twists are means over what the poses tell, {} late; that was used instead.',
    'smoothed': 'the twists are no sharper than the changes of the poses, which were used.',
    'counts': 'the twists are whole counts of encoders since the sample before, and were taken as '
    '{} older than their stamps.',
    'mean': 'the twists were taken as {} older than their stamps, as means over the past are; if '
    'they are not, the robot itself responds that late.',
    'speed': 'the speeds alone were taken as {} older than their stamps, as those of encoders '
    'beside a gyro are; if they are not, the robot itself responds that late.',
    'filter': 'the twists were taken as they were before a filter that delays them by {}: it '
    'explains them and their noise better than a robot that is late.',
    'undecided': 'the twists may be {} older than their stamps, as means over the past are; this '
    'recording does not tell. If they are, the robot itself is not late. Record faster.',
    'force': 'the robot moves before the forces that are told to drive it: they were taken as '
    '{} older than their stamps.',
}

BIAS = (
    'the odometry turns by {} while the robot stands, as a gyro with a bias does; that was taken '
    'off its turn rates.'
)

STOOD = (
    'its wheels were taken to begin {} rad (right) and {} rad (left) further in their turn than '
    'those of the first run, as the ripple tells.'
)

# Mass and inertia that are so many times what was declared, alike within a factor.
MANY, ALIKE = 3.0, 1.5
UNITS = (
    'Mass and inertia are {} and {} times what was declared, as where forces are told in another '
    'unit (torques, say). All that is found is in that unit.'
)

# Wheels twice as far apart as declared, or half as far, within a factor: b instead of 2 b.
TWICE, ABOUT = 2.0, 1.08
SEPARATION = (
    'The wheels act {} times as far apart as declared: is wheel_separation the whole distance '
    'between them, 2 b?'
)

NEAR_REST = (
    'Friction near rest is of another form than the declared law, as where wheels creep or yield '
    'before they slide. That was allowed for: without it, more would seem unexplained.'
)

NOISELESS = (
    'The odometry is finer than any robot tells it, as that of a simulator or a laboratory is, '
    'and what is left of it may be how it was made: white noise of {} and {} was added, as a good '
    'odometry has.'
)


def remarks(result: Identification) -> list[str]:
    """Say what was not taken as it was recorded or declared, and why."""
    biases = [f'{it.run}: {BIAS.format(turn_rate_text(it.rate))}' for it in result.biases]
    late = [f'{it.run}: {TIMINGS[it.taken].format(_milliseconds(it))}' for it in result.timings]
    stood = [
        f'{it.name}: {STOOD.format(*map(significant, it.wheel_angles))}'
        for it in result.runs
        if any(it.wheel_angles)
    ]
    units = [*_units(result), *_separation(result)]
    near_rest = [NEAR_REST] if result.near_rest > 0.0 else []
    return [*biases, *late, *stood, *units, *near_rest, *_noise(result.added_noise)]


def _units(result: Identification) -> list[str]:
    """Say where mass and inertia are both many times what was declared: so much are forces."""
    declared, now = result.declared.robot, result.identified.robot
    ratios = (now.mass / declared.mass, now.inertia / declared.inertia)
    low, high = min(ratios), max(ratios)
    if high > ALIKE * low or 1.0 / MANY < sqrt(low * high) < MANY:
        return []
    return [UNITS.format(*map(significant, ratios))]


def _separation(result: Identification) -> list[str]:
    """Say where the wheels are as far apart as if half their distance was mixed up with it."""
    ratio = result.identified.half_separation / result.declared.half_separation
    mixed_up = log(TWICE / ABOUT) < abs(log(ratio)) < log(TWICE * ABOUT)
    return [SEPARATION.format(significant(ratio))] if mixed_up else []


def _noise(added: ErrorNorm | None) -> list[str]:
    if added is None:
        return []
    return [NOISELESS.format(speed_text(added.v_rmse), turn_rate_text(added.omega_rmse))]


def _milliseconds(it: Timing) -> str:
    return f'{1e3 * it.lateness:.3g} ms'
