"""The state vector z that the stepper integrates, and what effects see of it."""

from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.dynamics import Laws
from diffbot_sim.physics.instant import HALF_SEPARATION, WHEEL_RADIUS, Inputs, Instant
from diffbot_sim.physics.kinematics import body_twist, wheel_speeds
from diffbot_sim.physics.stages import Motion
from diffbot_sim.records import Array

# Where things stand in z: pose, wheel angles [rad], wheel rim speeds [m/s].
X, Y, HEADING, ANGLE_RIGHT, ANGLE_LEFT, SPEED_RIGHT, SPEED_LEFT = range(7)
STATE_SIZE = 7

_of_body, _of_wheels = compiled(body_twist), compiled(wheel_speeds)


@compiled
def copy_state(z: Array, into: Array) -> None:
    """Copy number by number: a slice would need memory of its own, in case both overlap."""
    for index in range(STATE_SIZE):
        into[index] = z[index]


@compiled
def twist_of(params: Array, z: Array) -> tuple[float, float]:
    """Return speed [m/s] and turn rate [rad/s] of the moment."""
    return _of_body(z[SPEED_RIGHT], z[SPEED_LEFT], params[HALF_SEPARATION])


@compiled
def way_of(params: Array, z: Array) -> tuple[float, float]:
    """Return way [m] and turn [rad] since the wheels stood at angle 0."""
    r = params[WHEEL_RADIUS]
    return _of_body(r * z[ANGLE_RIGHT], r * z[ANGLE_LEFT], params[HALF_SEPARATION])


@compiled
def roll(params: Array, z: Array, way: float, turn: float, share: float) -> None:
    """Turn the wheels, by a share, to where they stand after a way [m] and a turn [rad]."""
    right, left = _of_wheels(way, turn, params[HALF_SEPARATION])
    r = params[WHEEL_RADIUS]
    z[ANGLE_RIGHT] += share * (right / r - z[ANGLE_RIGHT])
    z[ANGLE_LEFT] += share * (left / r - z[ANGLE_LEFT])


@compiled
def motion_at(params: Array, z: Array, time: float, elapsed: float) -> Motion:
    """Gather what effects may look at."""
    v, omega = twist_of(params, z)
    pose = (z[X], z[Y], z[HEADING])
    wheels = (z[ANGLE_RIGHT], z[ANGLE_LEFT], z[SPEED_RIGHT], z[SPEED_LEFT])
    return Motion(time, elapsed, *pose, v, omega, *wheels)


@compiled
def evaluate(
    laws: Laws, params: Array, states: Array, at: Motion, inputs: Inputs, right: float, left: float
) -> Instant:
    """Run the stages; right and left are the directions in which the wheels roll or are pushed."""
    return laws(params, states, at, inputs, right, left)
