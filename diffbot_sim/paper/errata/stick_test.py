"""Erratum 5: the stick test of Fig. 7 sees only the wheel's own traction force."""

import numpy as np
from matplotlib.figure import Figure

from diffbot_sim.paper.constants import Constants
from diffbot_sim.paper.drawing import over, stacked
from diffbot_sim.paper.driving import drive
from diffbot_sim.paper.errata import printed
from diffbot_sim.paper.experiment import Claim, Experiment, Series
from diffbot_sim.records import Array

UNTIL, STEPS = 3.0, (0.01, 0.001)  # s; steps of the paper's scheme
# The right wheel drives, the left one has no traction of its own or nearly F_s against the turn.
STRONG, SHARE = 1.0, 0.95  # N; share of F_s
# |B/A| below this is as good as J = m b², where the paper's test is right.
LEAST_COUPLING = 1e-3
TIME, HELD_OURS = 't [s]', 'held: put right [mm]'
TORN_OURS, TORN_HELD = 'torn: put right [m]', 'torn: as in the paper, reset held [m]'


def run(constants: Constants) -> Series:
    """Return how far the left wheel rolls: held by friction, and torn loose by the body."""
    held = drive(constants.model, (0.0, STRONG, 0.0), until=UNTIL)
    torn = drive(constants.model, (0.0, *tearing(constants)), until=UNTIL)
    rolled = {
        _creep(step): 1e3 * _rolled(constants, (STRONG, 0.0), step, len(held.time))
        for step in STEPS
    }
    radius = constants.robot.wheel_radius
    return {
        TIME: held.time,
        HELD_OURS: 1e3 * radius * held.wheel_angle[:, 1],
        **rolled,
        TORN_OURS: radius * torn.wheel_angle[:, 1],
        TORN_HELD: np.zeros(len(held.time)),
    }


def tearing(constants: Constants) -> tuple[float, float]:
    """Return forces [N] of which the left one is below F_s while its reaction is above.

    The left wheel carries F_L + (B/A) n_R, and n_R is at least F_R - F_s.
    """
    static, ratio = constants.friction.law().static, coupling(constants)
    right = static + 3.0 * (1.0 - SHARE) * static / max(abs(ratio), LEAST_COUPLING)
    return right, float(np.copysign(SHARE * static, ratio))


def coupling(constants: Constants) -> float:
    """Return B/A = (J − m b²) / (J + m b²)."""
    swing = constants.robot.mass * constants.robot.half_separation**2
    return (constants.robot.inertia - swing) / (constants.robot.inertia + swing)


def _rolled(constants: Constants, forces: tuple[float, float], step: float, rows: int) -> Array:
    """Return how far the left wheel rolls in the paper's scheme [m], at as many moments."""
    speed = printed.stick_test(constants, forces, UNTIL, step)[:, 1]
    way = np.concatenate([[0.0], np.cumsum(step * speed[1:])])
    return way[:: (len(way) - 1) // (rows - 1)]


def _creep(step: float) -> str:
    return f'held: as in the paper, {1e3 * step:g} ms steps [mm]'


def draw(series: Series, figure: Figure) -> None:
    """Draw how far the left wheel rolls in both cases."""
    upper, lower = stacked(figure, 2)
    over(upper, series, TIME, [HELD_OURS, *map(_creep, STEPS)], 'rolled [mm]')
    over(lower, series, TIME, [TORN_OURS, TORN_HELD], 'rolled [m]')


def claims(constants: Constants, series: Series) -> tuple[Claim, ...]:
    """Check that the shortcut lets a held wheel creep, or holds one that is torn loose."""
    crept = float(series[HELD_OURS][-1])
    creeps = [float(abs(series[_creep(step)][-1])) for step in STEPS]
    right, left = tearing(constants)
    torn = float(series[TORN_OURS][-1])
    return (
        Claim(
            'Fig. 7',
            'a left wheel without traction, beside a driven one, should stand still; with the '
            "paper's test and a reset at each change of sign it creeps, by an amount that is the "
            "step's",
            f'{STRONG:g} N on the right for {UNTIL:g} s: put right {crept:g} mm; printed '
            + ', '.join(
                f'{creep:.2g} mm at {1e3 * step:g} ms'
                for step, creep in zip(STEPS, creeps, strict=True)
            ),
            not series[HELD_OURS].any() and min(creeps) > 0.0,
        ),
        Claim(
            'Fig. 7',
            'a wheel whose own traction is below F_s can be torn loose through the body; a reset '
            "held by the paper's test would never let it go",
            f'F_R = {right:.2f} N, F_L = {left:.2f} N: the left wheel rolls {torn:.2f} m in '
            f'{UNTIL:g} s, the short test holds it',
            abs(left) < constants.friction.law().static and torn != 0.0,
        ),
    )


EXPERIMENT = Experiment(
    'erratum5',
    'Erratum 5: which force decides whether a wheel sticks, Fig. 7',
    "The paper compares a wheel's own traction force with F_s. But a stuck wheel also carries "
    'what reaches it through the body: F_L + (B/A) n_R for the left one, with n_R the net force '
    'on the right wheel and B/A = (J − m b²)/(J + m b²). Only for J = m b² do the two agree. The '
    'text leaves open whether the reset v_rst acts once or holds; both are shown.',
    run,
    {'erratum5': draw},
    claims,
)
