"""The introduction: what is wrong with the robot of Fig. 3, which has no friction."""

import numpy as np
from matplotlib.figure import Figure

from diffbot_sim.paper.constants import Constants
from diffbot_sim.paper.drawing import over
from diffbot_sim.paper.driving import drive
from diffbot_sim.paper.experiment import Claim, Experiment, Series
from diffbot_sim.physics.state import State

UNTIL, EVERY = 60.0, 0.1
PUSH, FAINT, SPEED = 0.5, 1e-9, 1.0  # N on each wheel, N, m/s
TIME, PUSHED = 't [s]', 'v pushed with 0.5 N [m/s]'
TOUCHED, COASTING = 'v pushed with 1 nN [m/s]', 'v coasting [m/s]'


def run(constants: Constants) -> Series:
    """Push it, touch it, and let it coast."""
    robot = constants.with_friction('none')
    pushed = drive(robot, (0.0, PUSH, PUSH), until=UNTIL, every=EVERY)
    touched = drive(robot, (0.0, FAINT, FAINT), until=UNTIL, every=EVERY)
    coasting = drive(robot, (0.0, 0.0, 0.0), until=UNTIL, every=EVERY, start=State(v=SPEED))
    runs = {PUSHED: pushed, TOUCHED: touched, COASTING: coasting}
    return {TIME: pushed.time, **{name: motion.twist[:, 0] for name, motion in runs.items()}}


def draw(series: Series, figure: Figure) -> None:
    """Draw the pushed and the coasting robot."""
    over(figure.subplots(), series, TIME, [PUSHED, COASTING], 'v [m/s]')


def claims(constants: Constants, series: Series) -> tuple[Claim, ...]:
    """Check the three faults that the introduction names."""
    pushed, touched, coasting = series[PUSHED], series[TOUCHED], series[COASTING]
    half = len(pushed) // 2
    expected = 2.0 * PUSH / constants.robot.mass
    return (
        Claim(
            'introduction',
            'without friction, a constant force accelerates the robot without limit',
            f'{pushed[half]:.2f} m/s after {UNTIL / 2:g} s, {pushed[-1]:.2f} after {UNTIL:g} s',
            bool(np.allclose(np.diff(pushed), expected * EVERY, rtol=1e-9)),
        ),
        Claim(
            'introduction',
            'without friction, any force at all sets it in motion',
            f'{FAINT:g} N on each wheel: {touched[1]:.2g} m/s after {EVERY:g} s',
            touched[1] > 0.0,
        ),
        Claim(
            'introduction',
            'without friction, it never slows down once the forces are zero',
            f'{coasting[-1] - coasting[0]:g} m/s lost in {UNTIL:g} s',
            bool((coasting == SPEED).all()),
        ),
    )


EXPERIMENT = Experiment(
    'frictionless',
    'Introduction: the robot without friction',
    'The robot of Fig. 3, eqs. (7) and (11) alone: pushed, barely touched, and coasting.',
    run,
    {'frictionless': draw},
    claims,
)
