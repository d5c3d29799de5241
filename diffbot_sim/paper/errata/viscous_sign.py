"""Erratum 2: in eq. (13) for v < 0, the viscous term pushes."""

import numpy as np
from matplotlib.figure import Figure

from diffbot_sim.paper.constants import Constants
from diffbot_sim.paper.drawing import over
from diffbot_sim.paper.driving import drive
from diffbot_sim.paper.errata import printed
from diffbot_sim.paper.experiment import Claim, Experiment, Series
from diffbot_sim.physics.state import State

UNTIL, STEP = 3.0, 0.01
BEYOND = 1.2  # of the speed at which the printed friction vanishes
ANY = 1.0  # [m/s], where there is no such speed for want of viscous friction
TIME, PRINTED, OURS = 't [s]', 'v by (13) as printed [m/s]', 'v by (13) put right [m/s]'


def run(constants: Constants) -> Series:
    """Let the robot roll backwards, left alone, by both signs."""
    law = constants.friction.law()
    start = -BEYOND * law.coulomb / law.viscous if law.viscous else -ANY
    right = drive(constants.model, (0.0, 0.0, 0.0), until=UNTIL, every=STEP, start=State(v=start))
    speed = np.full(len(right.time), start)
    for k, v in enumerate(speed[:-1]):  # explicit Euler is good enough to tell up from down
        speed[k + 1] = v - STEP * 2.0 * printed.friction(law, 0.0, v) / constants.robot.mass
    return {TIME: right.time, PRINTED: speed, OURS: right.twist[:, 0]}


def draw(series: Series, figure: Figure) -> None:
    """Draw both motions."""
    over(figure.subplots(), series, TIME, [PRINTED, OURS], 'v [m/s]')


def claims(constants: Constants, series: Series) -> tuple[Claim, ...]:
    """Check that the printed friction lets a robot that nobody pushes speed up."""
    wrong, right = series[PRINTED], series[OURS]
    return (
        Claim(
            'eq. (13)',
            'with the printed sign, a robot that rolls backwards speeds up by itself; with '
            'friction odd in v it slows down',
            f'from {wrong[0]:.2f} m/s, in {UNTIL:g} s: printed {wrong[-1]:.2f} m/s, '
            f'put right {right[-1]:.2f} m/s',
            bool((np.diff(wrong) < 0.0).all() and (np.diff(right) > 0.0).all()),
        ),
    )


EXPERIMENT = Experiment(
    'erratum2',
    'Erratum 2: viscous friction for v < 0, eq. (13)',
    'Printed: −F_k + (F_k − F_s) e^(a v) − F_v v. For v < 0 the last term is positive and pushes '
    'the robot on; beyond F_k/F_v it outweighs Coulomb friction. Friction is odd in v, so the '
    'term is + F_v v on both branches.',
    run,
    {'erratum2': draw},
    claims,
)
