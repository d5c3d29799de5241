"""What usual methods answer on the bags that identification is judged on.

pip install pysindy
python benchmarks/peers.py --seeds 0:2

Both regress accelerations, differentiated from the measured twist, on the same library of terms:
plain least squares with forward selection by BIC, and PySINDy's STLSQ over many thresholds.
"""

from argparse import ArgumentParser
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from peer_robots import MAKES
from recovery_cases import Case, cases
from recovery_judge import planted_in, recorded
from scipy.signal import savgol_filter

from diffbot_sim.identification.recordings.intervals import median_interval
from diffbot_sim.records import Array, Run

WINDOWS = (11, 31)  # of the polynomials that differentiate [samples]
DEGREE = 3
THRESHOLDS = tuple(np.geomspace(0.002, 0.5, 12))  # of STLSQ, in deviations of the acceleration
EARLIER = 0.06  # [s]
STANDING = 0.02  # slower than this is taken for rest [m/s, rad/s]
NOMINAL = 'nominal'
# Terms cannot tell these apart; either name counts.
ALIKE = {'actuator_delay': 'actuator_lag', 'actuator_deadband': 'actuator_saturation'}


@dataclass(frozen=True)
class Regression:
    """Terms, shape (n, p), the effect that each stands for, and the acceleration, shape (n,)."""

    terms: Array
    effects: tuple[str, ...]
    acceleration: Array


@dataclass(frozen=True)
class Motion:
    """What terms are made of, each shape (n,), or (n, 2) for the right and the left wheel."""

    v: Array
    omega: Array
    heading: Array
    wheels: Array
    moving: Array
    angle: Array
    force: Array
    earlier: Array
    share: Array


def motion(case: Case, run: Run, window: int) -> Motion:
    """Smooth what was measured."""
    time, plant = run.odometry.time, MAKES[case.make].plant
    step = median_interval(time)
    v, omega = savgol_filter(run.odometry.twist, window, DEGREE, axis=0).T
    wheels = np.column_stack([v + plant.half * omega, v - plant.half * omega])
    pose = run.odometry.pose
    return Motion(
        v,
        omega,
        np.cumsum(omega) * step if pose is None else pose[:, 2],
        wheels,
        np.where(np.abs(wheels) > STANDING, np.sign(wheels), 0.0),
        np.cumsum(wheels, axis=0) * step / plant.radius,
        _held(run, time),
        _held(run, time - EARLIER),
        time / time[-1],
    )


def regressions(case: Case, run: Run, window: int) -> tuple[Regression, Regression]:
    """Return the regressions of dv/dt and dω/dt."""
    at, step = motion(case, run, window), median_interval(run.odometry.time)
    slopes = savgol_filter(run.odometry.twist, window, DEGREE, deriv=1, delta=step, axis=0)
    along = [
        *shared_terms(at, np.array([1.0, 1.0])),
        ('quadratic_drag', at.v * abs(at.v)),
        ('slope', np.cos(at.heading)),
        ('slope', np.sin(at.heading)),
        ('com_offset', at.omega**2),
    ]
    about = [
        *shared_terms(at, np.array([1.0, -1.0])),
        ('quadratic_drag', at.omega * abs(at.omega)),
        ('yaw_friction', np.sign(at.omega) * (abs(at.omega) > STANDING)),
        ('com_offset', at.v * at.omega),
    ]
    return _regression(along, slopes[:, 0]), _regression(about, slopes[:, 1])


def shared_terms(at: Motion, sides: Array) -> list[tuple[str, Array]]:
    """List the terms of the wheels, added up with these signs."""
    other = sides * [1.0, -1.0]
    return [
        (NOMINAL, at.force @ sides),
        (NOMINAL, at.moving @ sides),
        (NOMINAL, at.wheels @ sides),
        ('wheel_friction_asymmetry', at.moving @ other),
        ('wheel_friction_asymmetry', at.wheels @ other),
        ('direction_dependent_friction', abs(at.moving) @ sides),
        ('direction_dependent_friction', abs(at.wheels) @ sides),
        ('actuator_lag', (at.earlier - at.force) @ sides),
        ('actuator_gain', at.force @ other),
        ('actuator_saturation', np.sign(at.force) @ sides),
        ('actuator_saturation', (at.force * abs(at.force)) @ sides),
        ('actuator_fade', at.share * (at.force @ sides)),
        ('friction_drift', at.share * (at.moving @ sides)),
        ('force_bias', np.ones(len(at.v))),
        ('payload_change', (at.share > 0.5) * (at.force @ sides)),
        *(
            ('wheel_ripple', wave(order * at.angle[:, wheel]) * sides[wheel])
            for order in (1, 2, 3)
            for wave in (np.cos, np.sin)
            for wheel in range(2)
        ),
    ]


def _regression(terms: Sequence[tuple[str, Array]], slope: Array) -> Regression:
    """Scale terms and acceleration to unit size; leave out what the drive never shows."""
    shown = [(name, term) for name, term in terms if np.any(term != 0.0)]
    matrix = np.column_stack([term / np.sqrt(np.mean(term**2)) for _, term in shown])
    return Regression(matrix, tuple(name for name, _ in shown), slope / np.std(slope))


def _held(run: Run, time: Array) -> Array:
    commands = run.commands
    index = np.searchsorted(commands.time, time, side='right') - 1
    return np.where(index[:, None] >= 0, commands.force[np.maximum(index, 0)], 0.0)


def by_bic(pair: Sequence[Regression]) -> set[str]:
    """Add the effect that lowers the BIC most, until none does."""
    names = {name for regression in pair for name in regression.effects} - {NOMINAL}
    found: set[str] = set()
    best = _bic(pair, found)
    while names - found:
        scores = {name: _bic(pair, {*found, name}) for name in names - found}
        name = min(scores, key=lambda n: scores[n])
        if scores[name] >= best:
            break
        found, best = {*found, name}, scores[name]
    return found


def _bic(pair: Sequence[Regression], chosen: set[str]) -> float:
    total = 0.0
    for regression in pair:
        used = [i for i, n in enumerate(regression.effects) if n == NOMINAL or n in chosen]
        terms, count = regression.terms[:, used], len(regression.acceleration)
        amounts = np.linalg.lstsq(terms, regression.acceleration, rcond=None)[0]
        missed = regression.acceleration - terms @ amounts
        total += count * np.log(np.mean(missed**2)) + len(used) * np.log(count)
    return float(total)


def by_stlsq(threshold: float) -> Callable[[Sequence[Regression]], set[str]]:
    """Return PySINDy's sequentially thresholded least squares at a threshold."""
    from pysindy import STLSQ  # a peer, no dependency of the project

    def found(pair: Sequence[Regression]) -> set[str]:
        names = set()
        for regression in pair:
            fit = STLSQ(threshold=threshold, alpha=1e-6)
            fit.fit(regression.terms, regression.acceleration[:, None])
            kept = np.flatnonzero(np.ravel(fit.coef_))
            names |= {regression.effects[i] for i in kept}
        return names - {NOMINAL}

    return found


def methods() -> Iterator[tuple[str, int, Callable[[Sequence[Regression]], set[str]]]]:
    """List methods with the window that they differentiate by."""
    for window in WINDOWS:
        yield f'least squares + BIC, window {window}', window, by_bic
        for threshold in THRESHOLDS:
            yield f'STLSQ {threshold:.3f}, window {window}', window, by_stlsq(threshold)


def main() -> None:
    """Judge every method on clean and single-effect cases; print Markdown."""
    parser = ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--seeds', default='0:1', help='FIRST:END')
    seeds = range(*map(int, parser.parse_args().seeds.split(':')))
    chosen = [
        (case, recorded(case, planted_in(case)[0]))
        for case in cases(('clean', 'single'), seeds, 1.0)
        if case.size != 'weak'
    ]
    clean = sum(not case.effects for case, _ in chosen)
    print(f'{clean} clean robots, {len(chosen) - clean} with one typical effect.\n')
    print(
        '| method | clean flagged | among those found | found alone |',
        '|---|---|---|---|',
        sep='\n',
    )
    for name, window, method in methods():
        flagged = among = alone = 0
        for case, run in chosen:
            found = method(regressions(case, run, window))
            true = {ALIKE.get(effect, effect) for effect in case.effects}
            flagged += not case.effects and bool(found)
            among += bool(true) and true <= found
            alone += bool(true) and true == found
        print(f'| {name} | {flagged} | {among} | {alone} |', flush=True)


if __name__ == '__main__':
    main()
