"""Figs. 8 and 9: the friction block alone, fed with a prescribed force and speed."""

from functools import partial
from math import inf

import numpy as np
from matplotlib.figure import Figure

from diffbot_sim.paper.constants import Constants
from diffbot_sim.paper.drawing import over, stacked
from diffbot_sim.paper.experiment import Claim, Experiment, Series
from diffbot_sim.physics.friction import friction_force
from diffbot_sim.records import Array

# As the paper gives them: F_ext = sin t, and v half of it, a second later.
AMPLITUDE, SHARE, DELAY = 1.0, 0.5, 1.0
UNTIL, EVERY = 10.0, 0.005
TIME, FORCE, SPEED, FRICTION = 't [s]', 'F_ext [N]', 'v [m/s]', 'F_fr [N]'
# Sampled curves agree with a law to rounding.
EXACT = 1e-12


def run(kind: str, constants: Constants) -> Series:
    """Feed one setting of the block; it is at rest until the delayed sine begins."""
    time = np.linspace(0.0, UNTIL, round(UNTIL / EVERY) + 1)
    force = AMPLITUDE * np.sin(time)
    speed = SHARE * AMPLITUDE * np.sin(np.maximum(time - DELAY, 0.0))
    friction = friction_force(constants.with_friction(kind).friction, speed, force)
    return {TIME: time, FORCE: force, SPEED: speed, FRICTION: friction}


def draw(series: Series, figure: Figure) -> None:
    """Draw input and output over time."""
    upper, lower = stacked(figure, 2)
    over(upper, series, TIME, [FORCE, SPEED], 'F_ext [N], v [m/s]')
    over(lower, series, TIME, [FRICTION])


def coulomb_claims(constants: Constants, series: Series) -> tuple[Claim, ...]:
    """Check what is said of Fig. 8: static and kinetic Coulomb friction."""
    rest, force, friction = series[SPEED] == 0.0, series[FORCE], series[FRICTION]
    limit = constants.friction.law().coulomb
    weak = rest & (np.abs(force) < limit)
    sizes = np.abs(friction[~rest])
    return (
        _balance('Fig. 8', force[weak], friction[weak]),
        Claim(
            'Fig. 8',
            'at rest, friction grows no further than F_k',
            f'largest {friction[rest].max():.3g} N while F_ext reaches {force[rest].max():.3g} N',
            friction[rest].max() == limit < force[rest].max(),
        ),
        Claim(
            'Fig. 8',
            'in motion, friction has the same size at every speed',
            f'{sizes.min():.3g} to {sizes.max():.3g} N',
            bool((sizes == limit).all()),
        ),
        _opposition('Fig. 8', series),
    )


def generalized_claims(constants: Constants, series: Series) -> tuple[Claim, ...]:
    """Check what is said of Fig. 9: stiction, Stribeck, Coulomb and viscous friction all show."""
    time, speed, force, friction = (series[name] for name in (TIME, SPEED, FORCE, FRICTION))
    law, rest = constants.friction.law(), speed == 0.0
    weak = rest & (np.abs(force) < law.static)
    start = (time > DELAY) & (time < DELAY + 0.5 * np.pi)
    least = int(np.argmin(friction[start]))
    rising = friction[start][least:]
    viscous = rising[-1] - rising[0]
    return (
        _balance('Fig. 9', force[weak], friction[weak]),
        Claim(
            'Fig. 9',
            'stiction: rest withstands F_s, more than Coulomb friction',
            f'{friction[rest].max():.3g} N at rest, F_k = {law.coulomb:.3g} N',
            friction[rest].max() == law.static > law.coulomb,
        ),
        Claim(
            'Fig. 9',
            'Stribeck: once moving, friction falls from F_s without a step',
            f'{friction[start][0]:.3f} N at {speed[start][0]:.4f} m/s, least {rising[0]:.3f} N at '
            f'{speed[start][least]:.3f} m/s',
            least > 1 and bool((np.diff(friction[start][: least + 1]) < 0.0).all()),
        ),
        Claim(
            'Fig. 9',
            'viscous: at larger speeds friction grows with speed',
            f'{viscous:.3f} N more at {speed[start].max():.2f} m/s than at its least',
            bool((np.diff(rising) >= -EXACT).all()) and viscous > 0.0,
        ),
        _opposition('Fig. 9', series),
    )


def _balance(source: str, force: Array, friction: Array) -> Claim:
    gap = float(np.abs(force - friction).max(initial=0.0))
    return Claim(
        source,
        'at rest, friction balances a force below the limit',
        f'largest difference {gap:.1g} N',
        len(force) > 0 and gap == 0.0,
    )


def _opposition(source: str, series: Series) -> Claim:
    power = (series[FRICTION] * series[SPEED])[series[SPEED] != 0.0]
    return Claim(
        source,
        'in motion, friction acts against it, whichever way the force points',
        f'takes {power.min(initial=inf):.2g} W or more throughout',
        len(power) > 0 and bool((power > 0.0).all()),
    )


COULOMB = Experiment(
    'fig8',
    'Fig. 8: Coulomb friction alone',
    'The block alone: normal force 10 N, external force sin t, speed half of that a second later. '
    'Friction model `coulomb`, so F_s = F_k.',
    partial(run, 'coulomb'),
    {'fig8': draw},
    coulomb_claims,
)
GENERALIZED = Experiment(
    'fig9',
    'Fig. 9: generalized friction',
    'The same inputs, friction model `generalized`: eq. (13) with its signs put right.',
    partial(run, 'generalized'),
    {'fig9': draw},
    generalized_claims,
)
