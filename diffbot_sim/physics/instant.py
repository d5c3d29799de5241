"""All that bears on the robot at one instant: eqs. (7), (11) with the effects put in."""

from typing import NamedTuple

from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.stages import Balance, Law, Load, Traction
from diffbot_sim.records import Array

# Where the robot's numbers, and those of its law of friction, stand among all that compiled code
# reads; behind them come the effects'.
MASS, INERTIA, HALF_SEPARATION, WHEEL_RADIUS, STATIC, COULOMB, EXCESS, VISCOUS, STRIBECK = range(9)
EFFECTS = STRIBECK + 1


class Inputs(NamedTuple):
    """What acts from outside: commanded traction [N], and a push on the body [N, N·m]."""

    right: float
    left: float
    force: float
    torque: float


class Instant(NamedTuple):
    """Inertia and load of the body without wheel friction, and the friction laws of the wheels.

    M dv/dt = force - f_R - f_L and J dω/dt = torque - b (f_R - f_L) - f_yaw, |f_yaw| up to
    dry_torque. traction_*: forces acting on the wheels; the rest as in stages.Law. SI units.
    """

    mass: float
    inertia: float
    b: float
    force: float
    torque: float
    dry_torque: float
    traction_right: float
    traction_left: float
    static_right: float
    coulomb_right: float
    excess_right: float
    viscous_right: float
    stribeck_right: float
    static_left: float
    coulomb_left: float
    excess_left: float
    viscous_left: float
    stribeck_left: float


@compiled
def nominal_law(
    params: Array, side: float, direction: float, traction: float, balance: Balance
) -> Law:
    """Return the friction law that both wheels share, for one of them."""
    own = (params[STATIC], params[COULOMB], params[EXCESS], params[VISCOUS], params[STRIBECK])
    return Law(side, direction, traction, balance.mass / params[MASS], *own, 0.0)


@compiled
def nominal_balance(params: Array, traction: Traction, load: Load) -> Balance:
    """Put traction and load on the rigid body of eqs. (7) and (11)."""
    return Balance(
        params[MASS],
        params[INERTIA],
        (traction.right + traction.left) + load.force,
        (traction.right - traction.left) * params[HALF_SEPARATION] + load.torque,
        load.gravity_x,
        load.gravity_y,
    )


@compiled
def gather(
    params: Array, traction: Traction, load: Load, balance: Balance, right: Law, left: Law
) -> Instant:
    """Bring the stages' results together."""
    body = (balance.mass, balance.inertia, params[HALF_SEPARATION])
    force = balance.force + balance.mass * balance.gravity_x
    return Instant(
        *body,
        force,
        balance.torque,
        load.dry_torque,
        traction.right,
        traction.left,
        right.static + right.lost,
        right.coulomb + right.lost,
        right.excess,
        right.viscous,
        right.stribeck,
        left.static + left.lost,
        left.coulomb + left.lost,
        left.excess,
        left.viscous,
        left.stribeck,
    )
