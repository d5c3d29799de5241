"""Whether mass and inertia are declared in their units: no fit goes as far as from g to kg."""

from math import log

import numpy as np

from diffbot_sim.errors import DataError
from diffbot_sim.identification.fitting.calibration import simulation_errors
from diffbot_sim.identification.fitting.coordinates import FREE_OF_ROBOT, Space
from diffbot_sim.identification.recordings.stretches import Stretch, motion_of
from diffbot_sim.identification.statistics.norms import rms_of_each
from diffbot_sim.records import Array

# Powers of ten that a number in another unit may be wrong by: g, kg·cm².
MISTAKES = (-4, -3, 3, 4)
# It is a mistake if without it less than this share is left of the motion, and of the error.
LEFT = 0.5


def check_units(space: Space, stretches: tuple[Stretch, ...]) -> None:
    """Refuse a mass, or an inertia, that moves as the runs do in another unit only: DataError."""
    # Around its mean: that is all that a body leaves which is too heavy to change its speed.
    motion = motion_of(stretches)

    def errors(point: Array) -> Array:
        return rms_of_each(simulation_errors(space, stretches, point))

    most = LEFT * np.minimum(motion, errors(space.prior()))
    # The mass, which shows in the speed, comes first, then the inertia, in the turn rate.
    for axis in range(len(FREE_OF_ROBOT)):
        points = [_mistaken(space, axis, mistake) for mistake in MISTAKES]
        left = [errors(point)[axis] for point in points]
        nearest = int(np.argmin(left))
        if left[nearest] < most[axis]:
            _refuse(space, axis, points[nearest])


def _mistaken(space: Space, index: int, mistake: int) -> Array:
    """Return what was declared, one number of it times a power of ten."""
    point = space.prior()
    point[index] += mistake * log(10.0)
    return point


def _refuse(space: Space, index: int, nearest: Array) -> None:
    wrong = space.nominal[index]
    declared, moves = (wrong.value(float(at[index])) for at in (space.prior(), nearest))
    raise DataError(
        f'robot.{wrong.name} is declared as {declared:g} {wrong.unit}, and the runs move as with '
        f'{moves:g}: is that another unit? Declare it in {wrong.unit}.'
    )
