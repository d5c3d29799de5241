"""Friction against turning on the spot: tyre scrub and casters."""

from dataclasses import dataclass

from diffbot_sim.parameters import parameter
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.effects.effect import Effect
from diffbot_sim.physics.stages import Load, Motion, Stage


@compiled
def scrub(at: Motion, load: Load, dry: float, viscous: float) -> Load:
    """Raise the limit of dry yaw friction and oppose turning with viscous torque."""
    return Load(
        load.force,
        load.torque - viscous * at.omega,
        load.dry_torque + dry,
        load.gravity_x,
        load.gravity_y,
    )


@dataclass(frozen=True)
class YawFriction(Effect):
    """Torque -dry·sign(ω) - viscous·ω; the dry part holds a resting robot."""

    name = 'yaw_friction'
    meaning = 'torque against turning: tyre scrub, casters'
    source = 'Coulomb and viscous friction about the yaw axis'
    stage = Stage.BODY_LOAD
    kernel = scrub
    dissipative = True
    guesses = ((0.1, 0.05), (1.0, 0.0), (0.0, 1.0))
    excitation = 'turning on the spot and in arcs, left and right, at several rates'

    dry: float = parameter(
        0.0, unit='N·m', low=0.0, high=1e4, scale=0.3, meaning='dry friction torque'
    )
    viscous: float = parameter(
        0.0, unit='N·m·s/rad', low=0.0, high=1e4, scale=0.3, meaning='viscous yaw friction'
    )
