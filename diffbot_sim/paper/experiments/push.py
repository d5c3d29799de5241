"""Figs. 10-12: two unequal forces for three seconds, then nothing."""

import numpy as np
from matplotlib.figure import Figure

from diffbot_sim.paper.constants import Constants
from diffbot_sim.paper.drawing import over, stacked
from diffbot_sim.paper.driving import drive
from diffbot_sim.paper.experiment import Claim, Experiment, Series

# As the paper gives them.
RIGHT, LEFT, PUSHED = 0.5, 0.51, 3.0
UNTIL = 8.0
# "Near F_k": nearer than this share of the way from F_k to F_s.
NEAR = 0.1
TIME, V, OMEGA, HEADING = 't [s]', 'v [m/s]', 'ω [rad/s]', 'φ [rad]'
X, Y, FRICTION_RIGHT, FRICTION_LEFT = 'x [m]', 'y [m]', 'F_fr right [N]', 'F_fr left [N]'


def run(constants: Constants) -> Series:
    """Push the robot and let it roll out."""
    motion = drive(constants.model, (0.0, RIGHT, LEFT), (PUSHED, 0.0, 0.0), until=UNTIL)
    x, y, heading = motion.pose.T
    return {
        TIME: motion.time,
        'F_R [N]': motion.traction[:, 0],
        'F_L [N]': motion.traction[:, 1],
        V: motion.twist[:, 0],
        OMEGA: motion.twist[:, 1],
        FRICTION_RIGHT: motion.friction[:, 0],
        FRICTION_LEFT: motion.friction[:, 1],
        X: x,
        Y: y,
        HEADING: heading,
    }


def draw_forces(series: Series, figure: Figure) -> None:
    """Fig. 10: what is fed in."""
    over(figure.subplots(), series, TIME, ['F_R [N]', 'F_L [N]'], 'traction [N]')


def draw_motion(series: Series, figure: Figure) -> None:
    """Fig. 11: the speed, and the friction on both wheels."""
    upper, lower = stacked(figure, 2)
    over(upper, series, TIME, [V])
    over(lower, series, TIME, [FRICTION_RIGHT, FRICTION_LEFT], 'F_fr [N]')


def draw_path(series: Series, figure: Figure) -> None:
    """Fig. 12: the path in the plane, to scale."""
    axes = figure.subplots()
    over(axes, series, X, [Y])
    axes.plot(series[X][-1], series[Y][-1], 'o', color='#0b3c5d')
    axes.set_aspect('equal', adjustable='datalim')


def claims(constants: Constants, series: Series) -> tuple[Claim, ...]:
    """Check every sentence about Figs. 10-12."""
    time, v, law = series[TIME], series[V], constants.friction.law()
    friction = np.column_stack([series[FRICTION_RIGHT], series[FRICTION_LEFT]])
    pushed, after = (time > 0.0) & (time < PUSHED), time > PUSHED
    least = friction[pushed].argmin(axis=0)
    falls = [bool((np.diff(friction[pushed][:k, i]) < 0.0).all()) for i, k in enumerate(least)]
    lowest, last = friction[pushed].min(axis=0), friction[pushed][-1]
    excess = float((lowest.max() - law.coulomb) / (law.static - law.coulomb))
    rolling = after & (v > 0.0)
    rest, heading = after & (v == 0.0), float(series[HEADING][-1])
    return (
        Claim(
            'Fig. 11',
            'both forces exceed F_s, so the robot is set in motion at once',
            f'F_s = {law.static:.3g} N; v = {1e3 * v[1]:.3g} mm/s after {time[1]:g} s',
            law.static < min(RIGHT, LEFT) and v[1] > 0.0,
        ),
        Claim(
            'Fig. 11',
            'while the speed rises, friction declines along the Stribeck curve',
            f'from {friction[pushed][0].max():.3f} N to {lowest.max():.3f} N within '
            f'{time[pushed][least.max()]:.2f} s',
            bool((least > 0).all()) and all(falls),
        ),
        Claim(
            'Fig. 11',
            'its least value is near Coulomb friction',
            f'{100.0 * excess:.1f} % of the way from F_k to F_s',
            0.0 <= excess < NEAR,
        ),
        Claim(
            'Fig. 11',
            'then viscous friction gains weight: friction rises with speed',
            f'{lowest.max():.3f} N to {last.max():.3f} N at {v[pushed][-1]:.2f} m/s',
            bool((last > lowest).all()),
        ),
        Claim(
            'Fig. 11',
            'after the push the robot slows down until it stops',
            f'stops {time[rest][0] - PUSHED:.2f} s after the push' if rest.any() else 'rolls on',
            rest.any() and bool((np.diff(v[rolling]) < 0.0).all()),
        ),
        Claim(
            'Fig. 11',
            'then speed and both friction forces are zero',
            f'v = {v[-1]:g} m/s, F_fr = {friction[-1, 0]:g} and {friction[-1, 1]:g} N',
            rest.any() and not friction[rest].any() and not v[rest].any(),
        ),
        Claim(
            'Fig. 12',
            'the robot turns towards the weaker force: right',
            f'in the end, heading {np.degrees(heading):.1f}° and y = {series[Y][-1]:.3f} m',
            heading < 0.0 and series[Y][-1] < 0.0,
        ),
    )


EXPERIMENT = Experiment(
    'fig10-12',
    'Figs. 10 to 12: two unequal forces for three seconds',
    'The whole robot with generalized friction: 0.5 N on the right and 0.51 N on the left wheel '
    'for 3 s, then none. The weaker side stops first; for a moment its wheel is held by friction '
    'of the other sign, against what reaches it through the body.',
    run,
    {'fig10': draw_forces, 'fig11': draw_motion, 'fig12': draw_path},
    claims,
)
