"""Whether the two EMPS files are of one axis: plain least squares of the force, file by file.

python benchmarks/emps_force.py --data DIR

No simulation, no starts, no noise model: force is explained by acceleration and by friction either
way, which is linear in all that is unknown. Numbers that differ here differ in the data. Then it
tells what each further force takes of what is left.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from emps import Axis, asked_axes
from scipy.signal import butter, filtfilt

from diffbot_sim.records import Array

CUT_OFF, SLOWER = 40.0, 20.0  # of the filters of position, and then of all that is compared [Hz]
MOVING = 5e-3  # friction is asked where the axis is faster than this [m/s]
EDGE = 50  # samples at either end that filters spoil
PITCH = 2.5e-3  # of the screw [m]
NAMES = ('mass', 'dry forward', 'dry backward', 'viscous forward', 'viscous backward')


@dataclass(frozen=True)
class Motion:
    """Force [N] and filtered position [m], speed [m/s], acceleration [m/s^2] at stamps [s]."""

    time: Array
    force: Array
    position: Array
    speed: Array
    acceleration: Array


def motion(axis: Axis) -> Motion:
    """Tell speed and acceleration from position, without delay."""
    step = float(axis.time[1] - axis.time[0])
    position = filtfilt(*butter(4, CUT_OFF, fs=1.0 / step), axis.position)
    speed = np.gradient(position, step)
    return Motion(axis.time, axis.force, position, speed, np.gradient(speed, step))


def friction(m: Motion) -> list[Array]:
    """Return the columns of inertia, dry and viscous friction, as in NAMES."""
    ahead, back = (m.speed > 0.0).astype(float), -(m.speed < 0.0).astype(float)
    return [m.acceleration, ahead, back, ahead * m.speed, -back * m.speed]


def further(m: Motion) -> dict[str, list[Array]]:
    """Return columns of forces that friction lacks."""
    way, turns = np.sign(m.speed), 2.0 * np.pi * m.position / PITCH
    return {
        'a pull in proportion to position': [m.position],
        'friction in proportion to position': [way * m.position],
        'friction in proportion to time': [way * m.time, m.speed * m.time],
        'friction in proportion to speed squared': [m.speed * np.abs(m.speed)],
        'a ripple along the screw': [np.sin(turns), np.cos(turns)],
    }


def explained(m: Motion, columns: Sequence[Array]) -> tuple[Array, float]:
    """Return the coefficients of columns, and the rms of the force that is left [N]."""
    slower = butter(4, SLOWER, fs=1.0 / float(m.time[1] - m.time[0]))
    asked = np.abs(m.speed) > MOVING
    asked[:EDGE] = asked[-EDGE:] = False
    x, y = (filtfilt(*slower, a, axis=0)[asked] for a in (np.column_stack(columns), m.force))
    found = np.linalg.lstsq(x, y, rcond=None)[0]
    return found, float(np.sqrt(np.mean((y - x @ found) ** 2)))


def table(axes: Sequence[Axis]) -> str:
    """Return Markdown: the numbers of each file, and what further forces take."""
    moved = [motion(axis) for axis in axes]
    plain = [explained(m, friction(m)) for m in moved]
    lines = ['| | training file | test file |', '|---|---|---|']
    for name, values in zip(NAMES, np.transpose([found for found, _ in plain]), strict=True):
        lines.append(f'| {name} | {values[0]:.1f} | {values[1]:.1f} |')
    before = [left for _, left in plain]
    lines.append(f'| force left, rms [N] | {before[0]:.2f} | {before[1]:.2f} |')
    for name in further(moved[0]):
        after = [explained(m, friction(m) + further(m)[name])[1] for m in moved]
        shares = 100.0 * (1.0 - np.array(after) / before)
        lines.append(f'| taken by {name} | {shares[0]:.1f} % | {shares[1]:.1f} % |')
    return '\n'.join(lines)


if __name__ == '__main__':
    print(table(asked_axes(__doc__)))
