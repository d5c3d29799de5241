"""What pulls the peer plant from outside, and turns with neither the robot nor its wheels."""

from math import cos, exp, hypot, pi, sin

from numba import njit
from peer_forces import GRAVITY
from peer_plant import Plant


@njit(cache=True)
def surroundings(
    p: Plant, time: float, mass: float, place: tuple[float, float], yaw: float
) -> float:
    """Return the force along the robot [N] of wind, waves of the ground, a mound and a tether.

    place: of the robot [m]; the tether is fixed where the robot started.
    """
    x, y = place
    force = p.wind * cos(p.wind_angle + p.wind_turn * time - yaw)
    if p.wave != 0.0:
        force -= mass * GRAVITY * p.wave * sin(2.0 * pi * x / p.wave_length) * cos(yaw)
    if p.mound != 0.0:
        east, north = (x - p.mound_x) / p.mound_radius, (y - p.mound_y) / p.mound_radius
        height = p.mound * exp(-0.5 * (east**2 + north**2))
        force += mass * GRAVITY * height / p.mound_radius * (east * cos(yaw) + north * sin(yaw))
    away = hypot(x, y)
    if away > p.tether_slack:
        taut = p.tether * (away - p.tether_slack) / away
        force -= taut * (x * cos(yaw) + y * sin(yaw))
    return force
