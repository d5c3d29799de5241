"""How often a 95 % interval holds the number that was planted."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from recovery_cases import Row

# Parameters that mean the same in both: of an effect, and the plant's number for it.
SAME = {
    'quadratic_drag': {'coefficient': 'drag'},
    'slope': {'grade_x': 'rise_x', 'grade_y': 'rise_y'},
    'yaw_friction': {'dry': 'yaw_dry', 'viscous': 'yaw_viscous'},
    'actuator_lag': {'time_constant': 'lag'},
    'actuator_delay': {'time': 'delay'},
    'actuator_saturation': {'limit': 'saturation'},
    'actuator_deadband': {'band': 'deadband'},
    'power_limit': {'power': 'power'},
    'voltage_limit': {'stall_force': 'stall', 'no_load_speed': 'no_load'},
    'force_bias': {'right': 'bias_right', 'left': 'bias_left'},
    'com_offset': {'offset': 'ahead'},
    'payload_change': {'mass': 'load_mass', 'inertia': 'load_inertia', 'moment': 'load_time'},
}
# With one of these the scale of all forces is a matter of convention.
SCALING = ('actuator_gain', 'actuator_fade')


class Interval(NamedTuple):
    """A parameter of a rightly found effect, and whether its interval holds the truth."""

    name: str
    floor: str
    holds: bool


def intervals(rows: Sequence[Row]) -> Iterator[Interval]:
    """Compare the intervals of rightly found effects with what was planted."""
    for row in rows:
        if row['family'] not in ('single', 'pairs', 'sizes') or row['verdict'] == 'failed':
            continue
        if set(SCALING) & set(row['effects']):
            continue
        for effect in set(row['found']) & set(row['effects']) & set(SAME):
            for parameter, number in SAME[effect].items():
                _, low, high = row['parameters'][effect][parameter]
                held = low <= row['planted'].get(number, 0.0) <= high
                yield Interval(f'{effect}.{parameter}', row['floor'], held)


def coverage(rows: Sequence[Row]) -> str:
    """Return a Markdown table of the share of intervals that hold the truth."""
    found = list(intervals(rows))
    if not found:
        return ''
    lines = ['## Intervals', '', '| parameter | hold the truth |', '|---|---|']
    for name in dict.fromkeys(sorted(item.name for item in found)):
        lines.append(f'| {name} | {_share([i for i in found if i.name == name])} |')
    for floor in ('smooth', 'rough'):
        lines.append(f'| all, {floor} | {_share([i for i in found if i.floor == floor])} |')
    return '\n'.join([*lines, f'| all | {_share(found)} |'])


def _share(found: Sequence[Interval]) -> str:
    return f'{sum(item.holds for item in found)} of {len(found)}'
