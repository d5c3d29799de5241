"""Wheels that act farther apart than they were measured to be."""

from dataclasses import dataclass

from diffbot_sim.parameters import parameter
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.effects.effect import Effect
from diffbot_sim.physics.stages import Balance, Motion, Stage


@compiled
def as_it_is(at: Motion, balance: Balance, widening: float) -> Balance:
    """Pass the balance on: the geometry has been widened before any kernel."""
    return balance


@dataclass(frozen=True)
class EffectiveTrack(Effect):
    """Wheel separation times 1 + widening, for speeds and forces of the wheels alike.

    The yaw rate that odometry tells is taken for the robot's own, not for that of encoders and the
    declared separation. One that is measured too large by a share s looks the same, with
    -s / (1 + s).
    """

    name = 'effective_track'
    meaning = 'wheels act farther apart (+) or nearer (-) than declared, or the gyro is off'
    source = 'Borenstein, Feng (1996), UMBmark; Mandow et al. (2007), skid-steer kinematics'
    stage = Stage.INERTIA
    kernel = as_it_is
    guesses = ((0.05,), (-0.05,), (0.3,))
    excitation = 'arcs that each wheel stops and reverses in, turns on the spot, straight drives'

    widening: float = parameter(
        0.0, unit='-', low=-0.8, high=4.0, scale=0.03, meaning='share by which it is wider'
    )

    @property
    def track(self) -> float:
        """By what factor the wheels are farther apart."""
        return 1.0 + self.widening
