"""Erratum 4: how F_s, F_k and F_v follow from the coefficients is not written down."""

from dataclasses import replace

import numpy as np
from matplotlib.figure import Figure

from diffbot_sim.paper.constants import Constants
from diffbot_sim.paper.drawing import over
from diffbot_sim.paper.experiment import Claim, Experiment, Series
from diffbot_sim.physics.friction import friction_force

SPEED, LOADS = 'v [m/s]', (0.5, 1.0, 2.0)
# A product of three factors rounds in another order.
EXACT = 1e-12


def run(constants: Constants) -> Series:
    """Return F_fr over v under half, the whole and twice the normal force, and (12) alone."""
    speed, friction = np.linspace(0.005, 0.5, 100), constants.friction
    curves = {
        _column(load): friction_force(
            replace(friction, normal_force=load * friction.normal_force), speed, 0.0 * speed
        )
        for load in LOADS
    }
    plain = friction_force(constants.with_friction('coulomb').friction, speed, 0.0 * speed)
    return {SPEED: speed, **curves, '(12) [N]': plain}


def draw(series: Series, figure: Figure) -> None:
    """Draw the curves for three loads."""
    over(figure.subplots(), series, SPEED, [_column(load) for load in LOADS], 'F_fr [N]')


def claims(constants: Constants, series: Series) -> tuple[Claim, ...]:
    """Check that μ F_N is the reading that joins (12) and (13), and what units it gives."""
    half, whole, double = (series[_column(load)] for load in LOADS)
    friction = constants.friction
    coulomb = friction.mu_coulomb * friction.normal_force
    viscous = friction.mu_viscous * friction.normal_force
    gap = float(max(np.abs(double - 2.0 * whole).max(), np.abs(whole - 2.0 * half).max()))
    return (
        Claim(
            'eqs. (12), (13)',
            'with F_k = μ_k F_N, (12) is (13) without stiction and viscous friction',
            f'(12) gives {series["(12) [N]"][0]:.3g} N, μ_k F_N = {coulomb:.3g} N',
            bool((series['(12) [N]'] == coulomb).all()),
        ),
        Claim(
            'section 2.3',
            'with F_s = μ_s F_N and F_v = μ_v F_N too, all friction is in proportion to the '
            'normal force',
            f'largest departure {gap:.1g} N; F_v = {viscous:g} N·s/m, so μ_v is in s/m',
            gap < EXACT,
        ),
    )


def _column(load: float) -> str:
    return f'F_fr at {load:g} F_N [N]'


EXPERIMENT = Experiment(
    'erratum4',
    'Erratum 4: F_s, F_k and F_v',
    'The text gives coefficients μ and a normal force F_N. For Coulomb friction their product '
    'stands in (12); that F_s and F_v are products too, and that μ_v has the unit s/m, has to be '
    'inferred from the sentence that friction depends on the normal force.',
    run,
    {'erratum4': draw},
    claims,
)
