"""Erratum 1: eq. (3) has the wrong sign."""

import numpy as np
from matplotlib.figure import Figure

from diffbot_sim.paper.constants import Constants
from diffbot_sim.paper.drawing import over
from diffbot_sim.paper.errata import printed
from diffbot_sim.paper.experiment import Claim, Experiment, Series
from diffbot_sim.physics.kinematics import body_twist, turning_radius

LEFT = 0.3  # m/s
RIGHT, PRINTED, OURS = 'v_R [m/s]', 'v from (3) as printed [m/s]', 'v from (3) put right [m/s]'
TRUE = 'v = (v_R + v_L)/2 [m/s]'


def run(constants: Constants) -> Series:
    """Return v = R_o ω by both signs of (3), over the right wheel's speed."""
    b = constants.robot.half_separation
    right = np.linspace(
        0.0, 2.0 * LEFT, 100
    )  # even: v_R = v_L, where R_o is infinite, is no point
    twists = np.array([body_twist(speed, LEFT, b) for speed in right])
    wrong = np.array([printed.turning_radius(speed, LEFT, b) for speed in right])
    return {
        RIGHT: right,
        TRUE: twists[:, 0],
        PRINTED: wrong * twists[:, 1],
        OURS: turning_radius(right, np.full(100, LEFT), b) * twists[:, 1],
    }


def draw(series: Series, figure: Figure) -> None:
    """Draw v by both signs."""
    over(figure.subplots(), series, RIGHT, [TRUE, PRINTED, OURS], 'v [m/s]')


def claims(constants: Constants, series: Series) -> tuple[Claim, ...]:
    """Check that only the other sign agrees with (2) and (4)."""
    last = {name: values[-1] for name, values in series.items()}
    return (
        Claim(
            'eq. (3)',
            'as printed, R_o ω is the speed with the wrong sign; with v_R − v_L below the line '
            'it is v of (4)',
            f'v_R = {last[RIGHT]:g}, v_L = {LEFT:g} m/s: v = {last[TRUE]:.2f}, printed '
            f'{last[PRINTED]:.2f}, put right {last[OURS]:.2f} m/s',
            bool(
                np.allclose(series[PRINTED], -series[TRUE])
                and np.allclose(series[OURS], series[TRUE])
            ),
        ),
    )


EXPERIMENT = Experiment(
    'erratum1',
    'Erratum 1: the sign of the radius, eq. (3)',
    'Printed: R_o = b (v_R + v_L) / (−v_R + v_L). From (2), ω (R_o + b) = v_R and '
    'ω (R_o − b) = v_L, so the denominator is v_R − v_L; otherwise (4), v = R_o ω, fails.',
    run,
    {'erratum1': draw},
    claims,
)
