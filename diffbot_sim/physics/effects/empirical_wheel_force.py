"""A force on each wheel without a law: a table over one variable of that wheel."""

from dataclasses import dataclass

from diffbot_sim.parameters import parameter
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.effects.effect import Effect
from diffbot_sim.physics.effects.empirical_force import POINT_NAMES, POINTS, at_place, table_point
from diffbot_sim.physics.stages import Motion, Stage, Traction

AXES = ('wheels', 'difference')
VARIABLES = ('wheel_speed', 'wheel_force')


@compiled
def tabulated(  # type: ignore[no-untyped-def]
    at: Motion, traction: Traction, axis: float, variable: float, low: float, high: float, *points
) -> Traction:
    """Push each wheel as the table says at its own speed or force."""
    right = (at.speed_right, traction.right)[int(variable)]
    left = (at.speed_left, traction.left)[int(variable)]
    opposite = 1.0 - 2.0 * axis
    return Traction(
        traction.right + at_place(right, low, high, points),
        traction.left + opposite * at_place(left, low, high, points),
    )


@dataclass(frozen=True)
class EmpiricalWheelForce(Effect):
    """What identification adds where a structure of the wheels is left that no law explains."""

    name = 'empirical_wheel_force'
    meaning = 'force on each wheel by a table over its speed or force; no law, it only describes'
    source = 'learned from the residual of recorded drives'
    stage = Stage.DRIVETRAIN
    kernel = tabulated
    is_sought = False
    guesses = (('wheels', 'wheel_speed', -1.0, 1.0, *([0.5] * POINTS)),)
    excitation = 'the whole range of the variable'

    axis: str = parameter(
        'wheels', meaning='wheels: both alike; difference: left opposite', choices=AXES
    )
    variable: str = parameter('wheel_speed', meaning='what the table runs over', choices=VARIABLES)
    low: float = parameter(
        -1.0, unit='-', low=-1e5, high=1e5, meaning='value at the first point, in its SI unit'
    )
    high: float = parameter(
        1.0, unit='-', low=-1e5, high=1e5, meaning='value at the last point, in its SI unit'
    )
    point_1: float = table_point(0)
    point_2: float = table_point(1)
    point_3: float = table_point(2)
    point_4: float = table_point(3)
    point_5: float = table_point(4)
    point_6: float = table_point(5)
    point_7: float = table_point(6)
    point_8: float = table_point(7)
    point_9: float = table_point(8)
    point_10: float = table_point(9)
    point_11: float = table_point(10)
    point_12: float = table_point(11)

    @property
    def points(self) -> tuple[float, ...]:
        """The table [N]."""
        return tuple(getattr(self, name) for name in POINT_NAMES)
