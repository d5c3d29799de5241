"""What effects see and change: the values handed along the stages of one instant.

A kernel is a pure compiled function `kernel(at, value, *state, *parameters) -> value`, where
`value` is the tuple of its stage. Order: command, actuator, drivetrain, wheel friction, body load,
inertia.
"""

from enum import IntEnum
from math import copysign
from typing import Any, NamedTuple

from numba import types

from diffbot_sim.physics.compiled import compiled

# A force below this share of a limit is what it was.
FAR_BELOW = 0.05


class Stage(IntEnum):
    """Where an effect acts; effects are evaluated in this order.

    What motors are asked for, what they give, and what becomes of that on the way to the wheels:
    a limit is one of the motor's own force, whatever the gain behind it.
    """

    COMMAND = 0
    ACTUATOR = 1
    DRIVETRAIN = 2
    WHEEL_FRICTION = 3
    BODY_LOAD = 4
    INERTIA = 5


class Motion(NamedTuple):
    """The instant: time since the start of the run, pose and motion of robot and wheels.

    time [s]; elapsed [s] since effect states were last updated; x, y [m], heading [rad];
    v [m/s], omega [rad/s]; angle_* [rad] and speed_* [m/s] of each wheel.
    """

    time: float
    elapsed: float
    x: float
    y: float
    heading: float
    v: float
    omega: float
    angle_right: float
    angle_left: float
    speed_right: float
    speed_left: float


class Traction(NamedTuple):
    """Stages COMMAND, ACTUATOR and DRIVETRAIN: the force that drives each wheel [N]."""

    right: float
    left: float


class Law(NamedTuple):
    """Stage WHEEL_FRICTION: eq. (13) for one wheel in one direction of rolling.

    side is +1 for the right wheel and -1 for the left; direction is +1 forward, -1 backward;
    traction is the force that drives the wheel [N]; burden is the robot's mass as a share of the
    one it was declared with.
    |F_fr| = coulomb + excess·exp(-stribeck·|v|) + viscous·|v| + lost while rolling, and at most
    static + lost at rest; static, coulomb, excess and lost [N], viscous [N·s/m], stribeck [s/m].
    lost is what a gear takes: no weight, side or direction scales it.
    """

    side: float
    direction: float
    traction: float
    burden: float
    static: float
    coulomb: float
    excess: float
    viscous: float
    stribeck: float
    lost: float


class Load(NamedTuple):
    """Stage BODY_LOAD: what pushes the body besides the wheels.

    force [N] along the robot's x axis, torque [N·m] about the yaw axis, dry_torque [N·m]:
    limit of dry friction against turning; gravity_* [m/s²] along the robot's x and y axes.
    """

    force: float
    torque: float
    dry_torque: float
    gravity_x: float
    gravity_y: float


class Balance(NamedTuple):
    """Stage INERTIA: dv/dt = force/mass + gravity_x, dω/dt = torque/inertia, at the axle."""

    mass: float
    inertia: float
    force: float
    torque: float
    gravity_x: float
    gravity_y: float


def numba_type(value: type[NamedTuple]) -> Any:
    """Return the compiled type of one of the tuples above."""
    return types.NamedUniTuple(types.float64, len(value._fields), value)


@compiled
def scaled(law: Law, dry: float, viscous: float) -> Law:
    """Scale the dry and the viscous part of a friction law."""
    return Law(
        law.side,
        law.direction,
        law.traction,
        law.burden,
        law.static * dry,
        law.coulomb * dry,
        law.excess * dry,
        law.viscous * viscous,
        law.stribeck,
        law.lost,
    )


@compiled
def within(force: float, limit: float) -> float:
    """Return a force [N] cut off at ±limit."""
    return min(max(force, -limit), limit)


@compiled
def nearly_within(force: float, limit: float, bend: float) -> float:
    """Return a force [N] cut off at ±limit; at the limit itself 1 - 2^(-1/bend) of it is missing.

    For limits that depend on the motion: a corner there would cost the integrator its order, and
    a wide bend what is identified its truth. Beyond twenty times or a twentieth of the limit a
    bend of 12 or more is a corner, to the last bit.
    """
    asked = abs(force) / limit
    if asked <= FAR_BELOW:
        return force
    if asked >= 1.0 / FAR_BELOW:
        return copysign(limit, force)
    if asked <= 1.0:
        return force / (1.0 + asked**bend) ** (1.0 / bend)
    # The same, whatever the bend: a power of more than 1 may be more than any number.
    return copysign(limit, force) / (1.0 + asked**-bend) ** (1.0 / bend)


@compiled
def pushed(load: Load, force: float, torque: float) -> Load:
    """Add a force [N] along x and a torque [N·m] to a load."""
    return Load(
        load.force + force, load.torque + torque, load.dry_torque, load.gravity_x, load.gravity_y
    )
