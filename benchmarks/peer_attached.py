"""What is attached to the peer plant: a caster that trails its pivot, a load that swings."""

from math import cos, pi, sin, tanh

from numba import njit
from peer_plant import Plant

# Dry friction of the caster is full at these speeds [m/s, rad/s]; the wheels' is never softened.
ROLLS, SWIVELS = 0.01, 0.1


@njit(cache=True)
def caster(p: Plant, angle: float, v: float, omega: float) -> tuple[float, float, float]:
    """Return force [N] and torque [N·m] of the caster on the body, and how fast it swivels.

    angle: of its rolling direction from straight ahead [rad]. It does not slip sideways, so that
    speed and turning of the pivot swivel it; rolling and swivelling have dry friction.
    """
    along, across = cos(angle), sin(angle)
    rolling = v * along + omega * p.caster_ahead * across
    swivelling = (omega * p.caster_ahead * along - v * across) / p.caster_trail - omega
    roll = -p.caster_roll * tanh(rolling / ROLLS)
    swivel = -p.caster_swivel * tanh(swivelling / SWIVELS)
    force = roll * along - swivel * across / p.caster_trail
    torque = roll * p.caster_ahead * across
    torque += swivel * (p.caster_ahead * along / p.caster_trail - 1.0)
    return force, torque, swivelling


@njit(cache=True)
def swinging(p: Plant, swung: float, speed: float) -> tuple[float, float]:
    """Return the force [N] of a load on the body, and its own acceleration [m/s²] against it.

    swung [m] and speed [m/s]: of the load from where it hangs at rest, along the robot.
    """
    rate = 2.0 * pi * p.swing_rate
    back = rate**2 * swung + 2.0 * p.swing_damping * rate * speed
    return p.swing_mass * back, -back
