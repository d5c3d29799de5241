"""Erratum 3: in eq. (13) for v = 0, magnitudes and sign are missing."""

import numpy as np
from matplotlib.figure import Figure

from diffbot_sim.paper.constants import Constants
from diffbot_sim.paper.drawing import over
from diffbot_sim.paper.errata import printed
from diffbot_sim.paper.experiment import Claim, Experiment, Series
from diffbot_sim.physics.friction import friction_force

STRONGEST = 5.0  # times F_s
FORCE, PRINTED, OURS = 'F_ext [N]', 'F_fr as printed [N]', 'F_fr put right [N]'


def run(constants: Constants) -> Series:
    """Return the friction of a resting wheel by both readings, over the external force."""
    law = constants.friction.law()
    force = np.linspace(-STRONGEST, STRONGEST, 401) * law.static
    wrong = np.array([printed.friction(law, push, 0.0) for push in force])
    return {
        FORCE: force,
        PRINTED: wrong,
        OURS: friction_force(constants.friction, np.zeros(len(force)), force),
    }


def draw(series: Series, figure: Figure) -> None:
    """Draw both branches."""
    over(figure.subplots(), series, FORCE, [PRINTED, OURS], 'F_fr at rest [N]')


def claims(constants: Constants, series: Series) -> tuple[Claim, ...]:
    """Check that the printed branch holds a wheel against any pull backwards."""
    force, wrong, right = series[FORCE], series[PRINTED], series[OURS]
    static = constants.friction.law().static
    return (
        Claim(
            'eq. (13)',
            'as printed, a resting robot cannot be moved backwards by any force; with magnitudes '
            'and sign, a force stronger than F_s moves it either way',
            f'pulled back with {-force[0]:.2f} N, printed friction answers {wrong[0]:.2f} N, '
            f'put right {right[0]:.2f} N',
            bool((wrong[force < 0.0] == force[force < 0.0]).all())
            and right[0] == -static
            and right[-1] == static,
        ),
    )


EXPERIMENT = Experiment(
    'erratum3',
    'Erratum 3: friction at rest, eq. (13)',
    'Printed: F_ext where F_ext < F_s, else F_s. Every negative force is below F_s, however '
    'strong, and so is balanced. Meant: F_ext where |F_ext| ≤ F_s, else F_s · sign(F_ext).',
    run,
    {'erratum3': draw},
    claims,
)
