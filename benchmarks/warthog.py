"""Warthog: what a real skid-steer drive lacks, from the electric power of its two sides.

python benchmarks/warthog.py --data DIR     DIR holds warthog-drive/quasi_static_points.csv

Currents were logged once a second and on the battery's side, so only moments of steady motion can
be used: there the wheels' forces are what friction and effects take, and a side's power is force
times speed, plus what the side draws anyway. Fitted with one log left out, judged on that log.
"""

import json
import sys
from argparse import ArgumentParser
from collections.abc import Iterable, Sequence
from csv import DictReader
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from emps import MEASURED
from scipy.optimize import least_squares

from diffbot_sim.errors import DataError, DiffbotError
from diffbot_sim.parameters import Spec
from diffbot_sim.physics import Friction, Model, Robot
from diffbot_sim.physics.composition import compose
from diffbot_sim.physics.effects import Effect, sought_effects
from diffbot_sim.physics.instant import Inputs
from diffbot_sim.physics.stages import Motion, Stage
from diffbot_sim.records import Array

POINTS = 'quasi_static_points.csv'
RADIUS = 0.30  # of the wheels [m]
MASS, GRAVITY = 280.0, 9.81
STANDING = 0.02  # rim speeds below this count as none [m/s]
FAR = 500.0  # errors beyond this count linearly [W]
# Units in which friction and the idle power are fitted: 100 N, 100 N·s/m, 100 W.
UNIT = 100.0
STEADY = (Stage.WHEEL_FRICTION, Stage.BODY_LOAD, Stage.INERTIA)
# The table holds neither headings nor when a log's drive began.
UNSEEN = ('slope', 'payload_change', 'friction_drift')


@dataclass(frozen=True)
class Points:
    """Steady moments: log, rim speeds right and left [m/s], yaw rate [rad/s], power [W]."""

    log: Array
    speed: Array
    omega: Array
    power: Array

    def of(self, chosen: Array) -> 'Points':
        """Return some of the points."""
        return Points(self.log[chosen], self.speed[chosen], self.omega[chosen], self.power[chosen])

    @cached_property
    def track(self) -> float:
        """Effective track [m]: by the gyro, the wheels turn the robot as if so far apart."""
        difference = self.speed[:, 0] - self.speed[:, 1]
        return float(difference @ difference / (difference @ self.omega))


@dataclass(frozen=True)
class Structure:
    """Rolling friction, an idle power, and perhaps an effect, as a vector of numbers."""

    kind: type[Effect] | None
    track: float

    @property
    def start(self) -> Array:
        """Where fits start: 100 N and 100 N·s/m on each side, no idle power, a little effect."""
        return np.array([1.0, 1.0, 0.0, *np.full(len(self._specs), 0.1)])

    @property
    def bounds(self) -> tuple[Array, Array]:
        """Friction takes energy; an effect keeps to its own bounds."""
        pairs = list(zip(self._specs, self._units, strict=True))
        low = [0.0, 0.0, -np.inf, *(spec.low / unit for spec, unit in pairs)]
        high = [np.inf, np.inf, np.inf, *(spec.high / unit for spec, unit in pairs)]
        return np.array(low), np.array(high)

    def model(self, numbers: Array) -> Model:
        """Return the model that these numbers stand for."""
        load = MASS * GRAVITY / 2.0
        dry, viscous = numbers[:2] * UNIT / load
        friction = Friction('coulomb_viscous', load, mu_coulomb=dry, mu_viscous=viscous)
        effects = () if self.kind is None else (self.kind(*(numbers[3:] * self._units)),)
        return Model(Robot(MASS, 50.0, self.track, RADIUS), friction, effects)

    def power(self, numbers: Array, points: Points) -> Array:
        """Return what each side draws [W], shape (n, 2)."""
        return force(self.model(numbers), points) * points.speed + UNIT * numbers[2]

    @property
    def _specs(self) -> tuple[Spec, ...]:
        return self.kind.specs() if self.kind else ()

    @property
    def _units(self) -> Array:
        """What typical departures of a 10 kg robot become on one of this weight."""
        heavier = MASS / 10.0
        return np.array([s.scale * (heavier if 'N' in s.unit else 1.0) for s in self._specs])


def force(model: Model, points: Points) -> Array:
    """Return the force that each side needs to go on as it goes [N], shape (n, 2)."""
    evaluate = compose(model.kinds).laws
    params, b = model.pack(), model.robot.half_separation
    result = np.empty_like(points.speed)
    for row, (right, left) in enumerate(np.where(abs(points.speed) < STANDING, 0, points.speed)):
        turning = (right - left) / (2.0 * b)
        at = Motion(0.0, 0.0, 0.0, 0.0, 0.0, 0.5 * (right + left), turning, 0.0, 0.0, right, left)
        now = evaluate(params, np.empty(0), at, Inputs(0.0, 0.0, 0.0, 0.0), right, left)
        rubbing = [
            np.sign(right) * now.coulomb_right + now.viscous_right * right,
            np.sign(left) * now.coulomb_left + now.viscous_left * left,
        ]
        against = now.dry_torque * np.sign(turning) - now.torque
        result[row] = np.array(rubbing) + 0.5 * (np.array([1.0, -1.0]) * against / b - now.force)
    return result


def fitted(structure: Structure, points: Points) -> Array:
    """Return the numbers that explain the power best, robust to moments that are not steady."""

    def errors(numbers: Array) -> Array:
        return np.asarray((structure.power(numbers, points) - points.power).ravel())

    found = least_squares(
        errors, structure.start, bounds=structure.bounds, loss='huber', f_scale=FAR, x_scale='jac'
    )
    return np.asarray(found.x)


def held_out_errors(kind: type[Effect] | None, points: Points, judged: Points) -> Array:
    """Return errors of the power [W] on points that a structure was not fitted to."""
    structure = Structure(kind, points.track)
    return structure.power(fitted(structure, points), judged) - judged.power


def left_out(kind: type[Effect] | None, points: Points) -> Array:
    """Return the errors on every log, each by a fit to the others."""
    errors = np.empty_like(points.power)
    for log in np.unique(points.log):
        here = points.log == log
        errors[here] = held_out_errors(kind, points.of(~here), points.of(here))
    return errors


def explained(errors: Array, points: Points) -> float:
    """Return the share of the variance of the power that is explained."""
    return float(1.0 - np.sum(errors**2) / np.sum((points.power - points.power.mean()) ** 2))


def read_points(path: Path) -> dict[str, Points]:
    """Read the table; return the points of each terrain. Raises DataError where it is missing."""
    if not path.exists():
        raise DataError(
            f'{path}: there is no such file. It is made from the DRIVE data set '
            '(norlab-ulaval/DRIVE, Baril et al. 2023); give --data DIR or set DIFFBOT_DATA=DIR.'
        )
    with path.open(encoding='utf-8', newline='') as file:
        rows = list(DictReader(file))
    rows = [row for row in rows if _moves(row)]
    return {
        terrain: _points(row for row in rows if row['terrain'] == terrain)
        for terrain in sorted({row['terrain'] for row in rows})
    }


def _moves(row: dict[str, str]) -> bool:
    return any(
        abs(float(row[f'wheel_speed_{side}_rad_s'])) * RADIUS > STANDING
        for side in ('left', 'right')
    )


def _points(rows: Iterable[dict[str, str]]) -> Points:
    kept = list(rows)

    def pair(name: str) -> Array:
        return np.array([[float(row[name.format(s)]) for s in ('right', 'left')] for row in kept])

    return Points(
        np.array([row['log'] for row in kept]),
        RADIUS * pair('wheel_speed_{}_rad_s'),
        np.array([float(row['gyro_z_rad_s']) for row in kept]),
        pair('elec_power_{}_W'),
    )


def candidates() -> tuple[type[Effect], ...]:
    """Return the effects that steady motion can show."""
    sought = sought_effects().values()
    return tuple(kind for kind in sought if kind.stage in STEADY and kind.name not in UNSEEN)


def benchmark(points: dict[str, Points]) -> dict[str, Any]:
    """Try every effect on the grass logs; carry the best one over to asphalt."""
    grass, rows = points['grass'], []
    for kind in (None, *candidates()):
        errors = left_out(kind, grass)
        rms = float(np.sqrt(np.mean(errors**2)))
        rows.append((kind, {'explained': explained(errors, grass), 'rms_W': rms}))
    best = max((row for row in rows if row[0]), key=lambda row: row[1]['explained'])[0]
    assert best is not None
    structure = Structure(best, grass.track)
    effect = structure.model(fitted(structure, grass)).effects[0]
    return {
        'points': {terrain: len(p.log) for terrain, p in points.items()},
        'track': {terrain: p.track for terrain, p in points.items()},
        'named': best.name,
        'parameters': {s.name: getattr(effect, s.name) for s in best.specs()},
        'grass': {kind.name if kind else 'rolling friction': told for kind, told in rows},
        'asphalt': {
            name: explained(held_out_errors(kind, grass, points['asphalt']), points['asphalt'])
            for name, kind in (('rolling friction', None), (best.name, best))
        },
    }


def table(results: dict[str, Any]) -> str:
    """Tell the results in Markdown."""
    ranked = sorted(results['grass'].items(), key=lambda item: -item[1]['explained'])
    lines = ['| rolling friction and | explained, left-out logs | rms [W] |', '|---|---|---|']
    lines += [f'| {n} | {told["explained"]:.3f} | {told["rms_W"]:.0f} |' for n, told in ranked]
    values = ', '.join(f'{name} {value:.3g}' for name, value in results['parameters'].items())
    before, after = results['asphalt'].values()
    tracks = ', '.join(f'{track:.2f} m on {t}' for t, track in results['track'].items())
    return '\n'.join(
        [
            *lines,
            '',
            f'Named: {results["named"]} ({values}). Fitted on grass, asphalt is explained to '
            f'{before:.2f} before and {after:.2f} after. Effective track: {tracks}.',
        ]
    )


def main(words: Sequence[str] | None = None) -> int:
    """Run the benchmark; 1 when the data are not there."""
    parser = ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--data', type=Path, default=MEASURED, metavar='DIR')
    parser.add_argument('--out', type=Path, default=Path('out/warthog'), metavar='DIR')
    arguments = parser.parse_args(words)
    try:
        results = benchmark(read_points(arguments.data / 'warthog-drive' / POINTS))
    except DiffbotError as problem:
        print('error:', problem, file=sys.stderr)
        return 1
    arguments.out.mkdir(parents=True, exist_ok=True)
    (arguments.out / 'warthog.json').write_text(json.dumps(results, indent=2) + '\n', 'utf-8')
    print(table(results))
    return 0


if __name__ == '__main__':
    sys.exit(main())
