"""A load that is put on or taken off during the run."""

from dataclasses import dataclass

import numpy as np

from diffbot_sim.parameters import parameter
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.effects.effect import Effect, Excitation
from diffbot_sim.physics.stages import Balance, Law, Motion, Stage, scaled

# Steps begin at the moment itself but for rounding [s].
ROUNDING = 1e-9
# A load taken off leaves at least this share of the robot.
LEAST = 0.05
# Shares of the friction that are tried: none, and all of it in proportion to the mass.
SHARES = (0.0, 1.0)
# So much more friction for its weight comes of no load, but of another floor.
MOST_SHARE = 3.0
# Moments that are tried are so far apart, or more on long runs [s].
SPACING, MOST_TRIED = 1.5, 80


@compiled
def loaded(
    at: Motion, balance: Balance, mass: float, inertia: float, moment: float, friction_share: float
) -> Balance:
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


@compiled
def borne(
    at: Motion, law: Law, mass: float, inertia: float, moment: float, friction_share: float
) -> Law:
    """Let friction follow the weight."""
    if law.burden == 1.0:
        return law
    more = max(1.0 + friction_share * (law.burden - 1.0), 0.0)
    return scaled(law, more, more)


@dataclass(frozen=True)
class PayloadChange(Effect):
    """Mass and inertia jump, the speed does not.

    Friction, dry and viscous, times 1 + `friction_share`·(load / mass of the robot): 0 where
    casters carry the load, 1 where it presses on the driven wheels as the robot does, more where
    more so. A slope pulls at the load, too; a `com_offset` is that of the robot without it.
    """

    name = 'payload_change'
    meaning = 'mass and inertia jump at an unknown moment, and friction with the weight'
    source = (
        "a load set down or taken up at the robot's own speed; eqs. (7), (11) before and after"
    )
    stage = Stage.INERTIA
    kernel = loaded
    friction_kernel = borne
    is_of_time = True
    guesses = ((2.0, 0.05, 30.0, 0.0), (-2.0, -0.05, 30.0, 0.0))
    shape = ('moment', 'friction_share')
    onset = 'moment'
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
    friction_share: float = parameter(
        0.0,
        unit='-',
        low=0.0,
        high=MOST_SHARE,
        scale=0.5,
        meaning='by how much friction grows for the share by which mass does',
    )

    @property
    def moments(self) -> tuple[float, ...]:
        """The moment, where anything changes at all."""
        return (self.moment,) if self.mass or self.inertia else ()

    @property
    def is_credible(self) -> bool:
        """Whether the friction may come of the weight."""
        return self.friction_share < 0.99 * MOST_SHARE

    @classmethod
    def starts(cls, drive: Excitation) -> tuple[tuple[float, ...], ...]:
        """Try moments all along the run, with and without more friction."""
        count = int(min(max(drive.duration / SPACING, 4), MOST_TRIED))
        moments = np.linspace(0.0, drive.duration, count + 2)[1:-1]
        load = cls.guesses[0][:2]
        return tuple((*load, float(moment), share) for moment in moments for share in SHARES)
