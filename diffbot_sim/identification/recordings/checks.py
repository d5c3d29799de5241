"""Whether anything follows from stretches: forces that drive, and a robot that moves."""

from collections.abc import Sequence

import numpy as np

from diffbot_sim.errors import DataError
from diffbot_sim.identification.recordings.stretches import Stretch, largest_command
from diffbot_sim.identification.statistics.norms import rms_of_each, white_noise

# A twist moves that is so many times its noise, and more than this [m/s, rad/s], in the mean.
BEYOND_NOISE, HARMLESS = 1.2, 5e-4


def check(fitted: Sequence[Stretch], held_out: Sequence[Stretch]) -> None:
    """Refuse what nothing follows from, or what nothing can be judged on; raises DataError."""
    if not fitted:
        raise DataError('no run was given to learn from; give at least one.')
    if not any(map(moves, fitted)):
        raise DataError(
            f'{_names(fitted)}: the robot never moves in what is fitted; record a drive with '
            'forces that move it.'
        )
    if not any(np.any(np.ptp(stretch.twist, axis=0)) for stretch in fitted):
        raise DataError(
            f'{_names(fitted)}: odometry tells the same twist throughout; record it live.'
        )
    if largest_command(fitted) == 0.0:
        raise DataError(
            f'{_names(fitted)}: all forces are 0, so no motion follows from them; record the '
            'forces that drive the wheels, or name their topics.'
        )
    if not any(map(moves, held_out)):
        raise DataError(
            f'{_names(held_out)}: the robot never moves in what is held out '
            f'(from {min(s.time[0] for s in held_out):.3g} s on), so nothing can be judged there; '
            'drive to the end, or give another run to --validate.'
        )


def moves(stretch: Stretch) -> bool:
    """Say whether a robot is seen to move."""
    size = rms_of_each(stretch.twist)
    return bool(np.any(size > BEYOND_NOISE * white_noise(stretch.twist) + HARMLESS))


def _names(stretches: Sequence[Stretch]) -> str:
    return ', '.join(stretch.run.name for stretch in stretches)
