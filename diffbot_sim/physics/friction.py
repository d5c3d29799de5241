"""Wheel friction: eqs. (12) and (13), with the corrections that odd symmetry demands."""

from dataclasses import dataclass

import numpy as np

from diffbot_sim.errors import ConfigError
from diffbot_sim.parameters import parameter
from diffbot_sim.physics.stages import Law
from diffbot_sim.records import Array

MODELS = ('none', 'coulomb', 'coulomb_stiction', 'coulomb_viscous', 'generalized')
# The coefficients that each basic model of Fig. 6 uses.
ACTIVE = {
    'none': (),
    'coulomb': ('mu_coulomb',),
    'coulomb_stiction': ('mu_static', 'mu_coulomb'),
    'coulomb_viscous': ('mu_coulomb', 'mu_viscous'),
    'generalized': ('mu_static', 'mu_coulomb', 'mu_viscous', 'stribeck'),
}


@dataclass(frozen=True)
class Friction:
    """Friction of one wheel; both wheels have the same unless an effect says otherwise.

    Raises ConfigError when mu_coulomb exceeds mu_static in a model that uses both.
    """

    model: str = parameter('generalized', meaning='friction model (Fig. 6)', choices=MODELS)
    normal_force: float = parameter(
        49.05, unit='N', low=0.0, high=1e6, meaning='normal force F_N on each wheel'
    )
    mu_static: float = parameter(
        0.049, unit='-', low=0.0, high=10.0, scale=0.01, meaning='static friction coefficient μ_s'
    )
    mu_coulomb: float = parameter(
        0.031, unit='-', low=0.0, high=10.0, scale=0.01, meaning='Coulomb friction coefficient μ_k'
    )
    mu_viscous: float = parameter(
        0.08, unit='s/m', low=0.0, high=1e3, scale=0.02, meaning='viscous friction coefficient μ_v'
    )
    stribeck: float = parameter(
        25.0, unit='s/m', low=0.0, high=1e4, scale=10.0, meaning='Stribeck coefficient a_st'
    )

    def __post_init__(self) -> None:
        if 'mu_static' in ACTIVE.get(self.model, ()) and self.mu_coulomb > self.mu_static:
            raise ConfigError(
                f'friction.mu_coulomb: {self.mu_coulomb:g} exceeds friction.mu_static '
                f'{self.mu_static:g}; sliding friction is at most static friction. '
                'Raise mu_static or lower mu_coulomb.'
            )

    @property
    def active(self) -> tuple[str, ...]:
        """Names of the coefficients that the chosen model uses."""
        return ACTIVE[self.model]

    def law(self) -> Law:
        """Return F_s, F_k, the Stribeck excess and F_v = μ F_N of one wheel."""
        on = {name: getattr(self, name) if name in self.active else 0.0 for name in _NAMES}
        coulomb = on['mu_coulomb'] * self.normal_force
        static = max(on['mu_static'] * self.normal_force, coulomb)
        smooth = self.model == 'generalized'
        excess = static - coulomb if smooth else 0.0
        viscous = on['mu_viscous'] * self.normal_force
        return Law(0.0, 0.0, 0.0, 1.0, static, coulomb, excess, viscous, on['stribeck'], 0.0)


_NAMES = ('mu_static', 'mu_coulomb', 'mu_viscous', 'stribeck')


def friction_force(friction: Friction, speed: Array, external: Array) -> Array:
    """Return F_fr [N] of eqs. (12), (13) for speeds [m/s] and external forces [N].

    At speed 0: the external force, up to F_s in its direction.
    """
    law = friction.law()
    size = law.coulomb + law.excess * np.exp(-law.stribeck * np.abs(speed))
    rolling = np.sign(speed) * size + law.viscous * np.asarray(speed)
    return np.where(np.asarray(speed) == 0.0, np.clip(external, -law.static, law.static), rolling)
