"""What a force may depend on, at every sample: shape (k,) of the body, (k, 2) of the wheels."""

import numpy as np

from diffbot_sim.identification.fitting.views import View
from diffbot_sim.identification.free_forms.forms import Of
from diffbot_sim.records import Array

# Wheels that turning moves by less hardly turn [m/s].
HARDLY = 0.01


def time(view: View) -> Array:
    """Return the time since the start of the run [s]."""
    return view.stretch.time


def time_of_wheels(view: View) -> Array:
    """Return the same, once for each wheel."""
    return np.repeat(view.stretch.time[:, None], 2, axis=1)


def wheel_speeds(view: View) -> Array:
    """Return how fast each wheel rolls, either way [m/s]."""
    return np.abs(view.wheel_speed)


def rolling(view: View) -> Array:
    """Return which way each wheel rolls: 1, -1, or 0 at rest."""
    return np.sign(view.wheel_speed)


def rolls(view: View) -> Array:
    """Return 1 where a wheel rolls, 0 at rest."""
    return np.abs(rolling(view))


def turning(view: View) -> Array:
    """Return which way the robot turns: 1, -1, or 0."""
    return np.sign(view.omega)


def turning_of_wheels(view: View) -> Array:
    """Return which way turning moves each wheel: 1, -1, or 0 where it hardly does."""
    speed = _of_turning(view)
    return np.sign(speed) * (np.abs(speed) > HARDLY)


def share_of_turning(view: View) -> Array:
    """Return how fast each wheel rolls over how fast turning alone would move it."""
    return wheel_speeds(view) / np.maximum(np.abs(_of_turning(view)), HARDLY)


def driving(view: View) -> Array:
    """Return how hard each wheel is driven, or, below zero, braked [N]."""
    return np.asarray(view.force * rolling(view))


def power(view: View) -> Array:
    """Return the power that each wheel is asked for, or, below zero, is to take [W]."""
    return np.asarray(view.force * view.wheel_speed)


def others_force(view: View) -> Array:
    """Return the force commanded to the other wheel [N]."""
    return view.force[:, ::-1]


def share_of_force(view: View) -> Array:
    """Return each wheel's commanded force over the largest one."""
    return np.asarray(view.force / view.largest_force)


def along(index: int) -> Of:
    """Return where along x (0) or y (1) the robot is [m]; 0 where no pose is known."""

    def of(view: View) -> Array:
        pose = view.stretch.pose
        return np.zeros(len(view.stretch.time)) if pose is None else pose[:, index]

    return of


def along_of_wheels(index: int) -> Of:
    """Return the same, once for each wheel."""
    return lambda view: np.repeat(along(index)(view)[:, None], 2, axis=1)


def towards(index: int) -> Of:
    """Return how much of x (0) or y (1) lies along the robot."""
    return lambda view: np.asarray((np.cos, np.sin)[index](view.stretch.heading))


def _of_turning(view: View) -> Array:
    """Return at which speed turning moves each wheel [m/s], the right one first."""
    return np.outer(view.omega, view.mix[1])
