"""The columns of a table: names, units, meanings, and where they come from."""

from typing import NamedTuple

import numpy as np

from diffbot_sim.records import Array, Commands, Trajectory


class Column(NamedTuple):
    """What is known of one column."""

    name: str
    unit: str
    meaning: str


COLUMNS = (
    Column('time', 's', 'time since the start of the run'),
    Column('right_force_commanded', 'N', 'traction force asked of the right wheel from now on'),
    Column('left_force_commanded', 'N', 'the same of the left wheel'),
    Column('right_force_acting', 'N', 'traction force on the right wheel after actuator effects'),
    Column('left_force_acting', 'N', 'the same on the left wheel'),
    Column('right_wheel_speed', 'm/s', 'speed of the right wheel over the floor'),
    Column('left_wheel_speed', 'm/s', 'speed of the left wheel over the floor'),
    Column('right_wheel_angle', 'rad', 'angle through which the right wheel has turned'),
    Column('left_wheel_angle', 'rad', 'angle through which the left wheel has turned'),
    Column('v', 'm/s', 'forward speed of the axle midpoint'),
    Column('omega', 'rad/s', 'yaw rate, counter-clockwise'),
    Column('x', 'm', 'position of the axle midpoint, ahead of the start'),
    Column('y', 'm', 'position of the axle midpoint, to the left of the start'),
    Column('yaw', 'rad', 'heading, counter-clockwise, not wrapped at ±π'),
    Column('right_friction', 'N', 'friction on the right wheel, positive against forward motion'),
    Column('left_friction', 'N', 'friction on the left wheel, likewise'),
)


def columns_of(commands: Commands, motion: Trajectory) -> dict[str, Array]:
    """Return every column by name, with one value for each stamp of the motion.

    The first command is given at the first stamp or before.
    """
    values = np.column_stack(
        [
            motion.time,
            commands.held_at(motion.time),
            motion.traction,
            motion.wheel_speed,
            motion.wheel_angle,
            motion.twist,
            motion.pose,
            motion.friction,
        ]
    )
    names = (column.name for column in COLUMNS)
    return dict(zip(names, np.ascontiguousarray(values.T), strict=True))


def description() -> dict[str, dict[str, str]]:
    """Return unit and meaning of every column, to be written beside the numbers."""
    return {column.name: {'unit': column.unit, 'meaning': column.meaning} for column in COLUMNS}
