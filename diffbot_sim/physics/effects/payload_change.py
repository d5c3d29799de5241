"""A load that is put on or taken off during the run."""

from dataclasses import dataclass

import numpy as np

from diffbot_sim.parameters import parameter
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.effects.effect import Effect, Excitation
from diffbot_sim.physics.stages import Balance, Motion, Stage

# Steps begin at the moment itself but for rounding [s].
ROUNDING = 1e-9
# A load taken off leaves at least this share of the robot.
LEAST = 0.05
# Moments that are tried are so far apart, or more on long runs [s].
SPACING, MOST_TRIED = 1.5, 80


@compiled
def loaded(at: Motion, balance: Balance, mass: float, inertia: float, moment: float) -> Balance:
    """Add the load in steps that begin after the moment; no step reaches across it."""
    if at.time - at.elapsed < moment - ROUNDING:
        return balance
    return Balance(
        max(balance.mass + mass, LEAST * balance.mass),
        max(balance.inertia + inertia, LEAST * balance.inertia),
        balance.force,
        balance.torque,
        balance.gravity_x,
        balance.gravity_y,
    )


@dataclass(frozen=True)
class PayloadChange(Effect):
    """Mass and inertia jump, the speed does not."""

    name = 'payload_change'
    meaning = 'mass and inertia jump at an unknown moment'
    source = (
        "a load set down or taken up at the robot's own speed; eqs. (7), (11) before and after"
    )
    stage = Stage.INERTIA
    kernel = loaded
    is_of_time = True
    guesses = ((2.0, 0.05, 30.0), (-2.0, -0.05, 30.0))
    shape = ('moment',)
    excitation = 'the same starts and stops before and after the load changes'

    mass: float = parameter(
        0.0, unit='kg', low=-1e4, high=1e4, scale=0.5, meaning='mass added at the moment'
    )
    inertia: float = parameter(
        0.0, unit='kg·m²', low=-1e5, high=1e5, scale=0.02, meaning='inertia added at the moment'
    )
    moment: float = parameter(
        0.0, unit='s', low=0.0, high=1e5, scale=1.0, meaning='moment, from the start of the run'
    )

    @property
    def moments(self) -> tuple[float, ...]:
        """The moment, where anything changes at all."""
        return (self.moment,) if self.mass or self.inertia else ()

    @classmethod
    def starts(cls, drive: Excitation) -> tuple[tuple[float, ...], ...]:
        """Try moments all along the run."""
        count = int(min(max(drive.duration / SPACING, 4), MOST_TRIED))
        moments = np.linspace(0.0, drive.duration, count + 2)[1:-1]
        return tuple((*cls.guesses[0][:2], float(moment)) for moment in moments)
