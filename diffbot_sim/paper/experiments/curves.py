"""Figs. 4-6: friction over speed, for every setting of the one friction block."""

from functools import partial

import numpy as np
from matplotlib.figure import Figure

from diffbot_sim.paper.constants import Constants
from diffbot_sim.paper.drawing import over, stacked
from diffbot_sim.paper.experiment import Claim, Experiment, Series
from diffbot_sim.physics.friction import MODELS, friction_force

FASTEST = 0.5  # m/s
# At rest friction is a set; a strong push from either side shows its ends.
STRONG = 1e3  # N
FIGURES = {
    'fig4': ('coulomb', 'coulomb_stiction'),
    'fig5': ('generalized',),
    'fig6': MODELS,
}


def run(constants: Constants) -> Series:
    """Return F_fr [N] over v [m/s]; speed 0 stands three times: pushed back, left, pushed on."""
    ahead = np.geomspace(1e-4, FASTEST, 200)
    speed = np.concatenate([-ahead[::-1], [0.0, 0.0, 0.0], ahead])
    push = STRONG * np.sign(np.arange(len(speed)) - len(ahead) - 1)
    curves = {
        _column(kind): friction_force(constants.with_friction(kind).friction, speed, push)
        for kind in MODELS
    }
    return {'v [m/s]': speed, **curves}


def draw(kinds: tuple[str, ...], series: Series, figure: Figure) -> None:
    """Draw the curves of some settings, one panel each."""
    rows = stacked(figure, len(kinds), 1.3 if len(kinds) > 2 else 2.2)
    for axes, kind in zip(rows, kinds, strict=True):
        over(axes, series, 'v [m/s]', [_column(kind)], 'F_fr [N]')
        axes.set_title(kind, fontsize='medium', loc='left')


def claims(constants: Constants, series: Series) -> tuple[Claim, ...]:
    """Check what the text says of the four basic models and of the generalized one."""
    speed, law = series['v [m/s]'], constants.friction.law()
    coulomb, stiction, viscous, whole = (series[_column(kind)] for kind in MODELS[1:])
    ahead, rest = speed > 0.0, speed == 0.0
    slow = speed[ahead][np.argmin(whole[ahead])]
    return (
        Claim(
            'Fig. 4a',
            'Coulomb friction has one size at any speed and opposes the motion',
            f'{np.abs(coulomb[~rest]).min():.3g} to {np.abs(coulomb[~rest]).max():.3g} N',
            bool((coulomb[~rest] == law.coulomb * np.sign(speed[~rest])).all()),
        ),
        Claim(
            'Fig. 4b',
            'with μ_s > μ_k, rest withstands more than motion meets (stiction)',
            f'{stiction[rest].max():.3g} N at rest, {stiction[ahead].max():.3g} N moving',
            stiction[rest].max() == law.static > stiction[ahead].max() == law.coulomb,
        ),
        Claim(
            'section 2.3',
            'viscous friction grows with speed',
            f'{viscous[ahead][0]:.3g} N at {speed[ahead][0]:g} m/s, {viscous[-1]:.3g} N at '
            f'{speed[-1]:g} m/s',
            bool((np.diff(viscous[ahead]) > 0.0).all()),
        ),
        Claim(
            'Fig. 5',
            'the Stribeck curve replaces the step from F_s to F_k by a steady fall at small '
            'speeds, after which viscous friction takes over',
            f'starts at {whole[ahead][0]:.3f} N, least at {slow:.3f} m/s with '
            f'{whole[ahead].min():.3f} N, {whole[-1]:.3f} N at {speed[-1]:g} m/s',
            _falls_then_rises(whole[ahead]) and slow < 0.25 * FASTEST,
        ),
    )


def _falls_then_rises(values: np.ndarray) -> bool:
    least = int(np.argmin(values))
    steps = np.diff(values)
    return least > 0 and bool((steps[:least] < 0.0).all() and (steps[least:] > 0.0).all())


def _column(kind: str) -> str:
    return f'F_fr {kind} [N]'


EXPERIMENT = Experiment(
    'fig4-6',
    'Figs. 4 to 6: one friction law, every basic model',
    'Friction of one wheel over its speed, for each setting of `friction.model`. At rest friction '
    'is a set, drawn as a vertical line: it takes whatever value keeps the wheel at rest. Where '
    "the paper's block had a state input v_sta to notice rest and an output v_rst to reset the "
    'integrator, the stepper keeps a mode for each wheel (0 sticks, ±1 rolls that way; '
    '`physics/contact.py`): the mode does what v_sta did, and `arrive`, which sets the speed to '
    'exactly 0.0 at the located moment of the stop, what v_rst did.',
    run,
    {name: partial(draw, kinds) for name, kinds in FIGURES.items()},
    claims,
)
