"""The conclusion: what friction puts right."""

import numpy as np
from matplotlib.figure import Figure

from diffbot_sim.paper.constants import Constants
from diffbot_sim.paper.drawing import over
from diffbot_sim.paper.driving import drive
from diffbot_sim.paper.experiment import Claim, Experiment, Series
from diffbot_sim.physics.state import State

UNTIL, EVERY = 300.0, 0.1
SHOWN = 30.0  # s; later nothing changes
BELOW, ABOVE = 0.99, 1.01  # shares of F_s
PUSH, SPEED = 0.5, 1.0  # N on each wheel, m/s
TIME, HELD, TORN = 't [s]', 'v at 0.99 F_s [m/s]', 'v at 1.01 F_s [m/s]'
COASTING, PUSHED = 'v coasting [m/s]', 'v pushed with 0.5 N [m/s]'
TRACTION, FRICTION = 'F_R pushed with 0.5 N [N]', 'F_fr right pushed with 0.5 N [N]'
# Terminal speed is reached asymptotically: to this share.
SETTLED = 1e-3


def run(constants: Constants) -> Series:
    """Push it below and above F_s, let it coast, and push it for long."""
    robot, static = constants.model, constants.friction.law().static
    held = drive(robot, (0.0, BELOW * static, BELOW * static), until=UNTIL, every=EVERY)
    torn = drive(robot, (0.0, ABOVE * static, ABOVE * static), until=UNTIL, every=EVERY)
    coasting = drive(robot, (0.0, 0.0, 0.0), until=UNTIL, every=EVERY, start=State(v=SPEED))
    pushed = drive(robot, (0.0, PUSH, PUSH), until=UNTIL, every=EVERY)
    runs = {HELD: held, TORN: torn, COASTING: coasting, PUSHED: pushed}
    forces = {TRACTION: pushed.traction[:, 0], FRICTION: pushed.friction[:, 0]}
    return {TIME: held.time, **{name: r.twist[:, 0] for name, r in runs.items()}, **forces}


def draw(series: Series, figure: Figure) -> None:
    """Draw the four speeds."""
    axes = figure.subplots()
    over(axes, series, TIME, [PUSHED, TORN, COASTING, HELD], 'v [m/s]')
    axes.set_xlim(0.0, SHOWN)


def claims(constants: Constants, series: Series) -> tuple[Claim, ...]:
    """Check the four points of the conclusion."""
    held, torn, coasting, pushed = (series[n] for n in (HELD, TORN, COASTING, PUSHED))
    law = constants.friction.law()
    limit = (PUSH - law.coulomb) / law.viscous if law.viscous else np.inf
    stopped = coasting == 0.0
    gap = float(abs(series[TRACTION][-1] - series[FRICTION][-1]))
    return (
        Claim(
            'conclusion',
            'the robot does not move until the force overcomes F_s',
            f'{BELOW:g} F_s for {UNTIL:g} s: {held.max():g} m/s; '
            f'{ABOVE:g} F_s: {torn[1]:.2g} m/s after {EVERY:g} s',
            not held.any() and torn[1] > 0.0,
        ),
        Claim(
            'conclusion',
            'a moving robot left alone slows down and stops',
            f'from {SPEED:g} m/s to {coasting[-1]:g} in {series[TIME][stopped.argmax()]:.1f} s',
            stopped.any() and bool((np.diff(coasting[~stopped]) < 0.0).all()),
        ),
        Claim(
            'conclusion',
            'viscous friction gives the robot a maximal velocity',
            f'{pushed[-1]:.4f} m/s after {UNTIL:g} s, (F − F_k)/F_v = {limit:.4f} m/s',
            bool(abs(pushed[-1] - limit) < SETTLED * limit),
        ),
        Claim(
            'conclusion',
            'at constant velocity, traction balances friction instead of being zero',
            f'traction {series[TRACTION][-1]:.4f} N, friction {series[FRICTION][-1]:.4f} N',
            gap < SETTLED * PUSH and series[TRACTION][-1] > 0.0,
        ),
    )


EXPERIMENT = Experiment(
    'with-friction',
    'Conclusion: the robot with friction',
    'The robot of Fig. 7 with generalized friction: pushed just below and just above F_s, '
    'coasting, and pushed with 0.5 N on each wheel for five minutes.',
    run,
    {'with-friction': draw},
    claims,
)
