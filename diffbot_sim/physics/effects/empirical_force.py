"""A force without a law: a table over one variable, learned from data."""

from dataclasses import dataclass
from math import pi

from diffbot_sim.parameters import parameter
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.effects.effect import Effect
from diffbot_sim.physics.stages import Load, Motion, Stage, pushed

AXES = ('v', 'omega')
VARIABLES = ('v', 'omega', 'heading', 'wheel_angle', 'time')
POINTS = 12
POINT_NAMES = tuple(f'point_{i + 1}' for i in range(POINTS))
# Unlike these, other variables keep the value at the end of the table beyond it.
PERIODIC = ('heading', 'wheel_angle')
_FIRST_PERIODIC, _LAST_PERIODIC = (VARIABLES.index(name) for name in PERIODIC)


@compiled
def at_place(x: float, low: float, high: float, points: tuple[float, ...]) -> float:
    """Return a table's value at x: linear between points, constant beyond the ends."""
    last = len(points) - 1
    place = last * min(max((x - low) / max(high - low, 1e-9), 0.0), 1.0)
    below = min(int(place), last - 1)
    return points[below] + (place - below) * (points[below + 1] - points[below])


@compiled
def tabulated(  # type: ignore[no-untyped-def]
    at: Motion, load: Load, axis: float, variable: float, low: float, high: float, *points
) -> Load:
    """Push as the table says at the present value of the variable, linearly between points."""
    wheel_angle = 0.5 * (at.angle_right + at.angle_left)
    x = (at.v, at.omega, at.heading, wheel_angle, at.time)[int(variable)]
    if _FIRST_PERIODIC <= variable <= _LAST_PERIODIC:
        x -= 2.0 * pi * ((x + pi) // (2.0 * pi))
    push = at_place(x, low, high, points)
    return pushed(load, push, 0.0) if axis == 0.0 else pushed(load, 0.0, push)


def table_point(index: int) -> float:
    """Declare one point of a table [N or N·m]."""
    share = index / (POINTS - 1)
    value: float = parameter(
        0.0,
        unit='N',
        low=-1e5,
        high=1e5,
        scale=0.5,
        meaning=f'force, or torque [N·m], {share:.0%} of the way from low to high',
    )
    return value


@dataclass(frozen=True)
class EmpiricalForce(Effect):
    """What identification adds where structure is left that no law explains."""

    name = 'empirical_force'
    meaning = 'force or torque by a table over one variable; it has no law, it only describes'
    source = 'learned from the residual of recorded drives'
    stage = Stage.BODY_LOAD
    kernel = tabulated
    is_sought = False
    guesses = (('v', 'v', -1.0, 1.0, *([0.5] * POINTS)),)
    excitation = 'the whole range of the variable'

    axis: str = parameter('v', meaning='v: a force along the robot; omega: a torque', choices=AXES)
    variable: str = parameter('v', meaning='what the table runs over', choices=VARIABLES)
    low: float = parameter(
        -pi, unit='-', low=-1e5, high=1e5, meaning='value at the first point, in its SI unit'
    )
    high: float = parameter(
        pi, unit='-', low=-1e5, high=1e5, meaning='value at the last point, in its SI unit'
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
        """The table [N or N·m]."""
        return tuple(getattr(self, name) for name in POINT_NAMES)
