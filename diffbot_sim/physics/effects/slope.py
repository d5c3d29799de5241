"""Gravity along a tilted floor."""

from dataclasses import dataclass
from math import cos, sin

from diffbot_sim.parameters import parameter
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.effects.effect import Effect
from diffbot_sim.physics.stages import Load, Motion, Stage

STANDARD_GRAVITY = 9.80665


@compiled
def gravity(at: Motion, load: Load, grade_x: float, grade_y: float) -> Load:
    """Turn the world's downhill pull into the robot's axes; it acts on mass, whatever that is."""
    if grade_x == grade_y == 0.0:
        return load
    c, s = cos(at.heading), sin(at.heading)
    return Load(
        load.force,
        load.torque,
        load.dry_torque,
        load.gravity_x - STANDARD_GRAVITY * (grade_x * c + grade_y * s),
        load.gravity_y - STANDARD_GRAVITY * (grade_y * c - grade_x * s),
    )


@dataclass(frozen=True)
class Slope(Effect):
    """Acceleration -g·(grade_x, grade_y) in the world of the pose, so it turns with the heading.

    The vector points straight uphill; its length is the sine of the slope.
    """

    name = 'slope'
    meaning = 'gravity along a tilted floor, fixed in the world'
    source = 'inclined plane, F = m g sin α'
    stage = Stage.BODY_LOAD
    kernel = gravity
    guesses = ((0.01, 0.0), (0.0, 0.01))
    excitation = 'straight drives at opposite headings'

    grade_x: float = parameter(
        0.0, unit='-', low=-0.7, high=0.7, scale=0.005, meaning='sine of the rise towards world x'
    )
    grade_y: float = parameter(
        0.0, unit='-', low=-0.7, high=0.7, scale=0.005, meaning='sine of the rise towards world y'
    )
