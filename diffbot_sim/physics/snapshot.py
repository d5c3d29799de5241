"""All that the next step sets out from, as one row of numbers: z, modes, effect states."""

from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.contact import Modes
from diffbot_sim.physics.vector import STATE_SIZE
from diffbot_sim.records import Array

CONTACTS = 3


def snapshot_size(states: Array) -> int:
    """Return how many numbers a snapshot with such effect states has."""
    return STATE_SIZE + CONTACTS + len(states)


def states_in(snapshots: Array) -> int:
    """Return how many effect states each of these rows, shape (k, n), holds."""
    return int(snapshots.shape[1]) - STATE_SIZE - CONTACTS


@compiled
def keep(z: Array, modes: Modes, states: Array, row: Array) -> None:
    """Write a snapshot into a row."""
    for index in range(STATE_SIZE):
        row[index] = z[index]
    for index in range(CONTACTS):
        row[STATE_SIZE + index] = modes[index]
    for index in range(len(states)):
        row[STATE_SIZE + CONTACTS + index] = states[index]


@compiled
def restore(row: Array, z: Array, modes: Modes, states: Array) -> None:
    """Go back to the snapshot in a row."""
    for index in range(STATE_SIZE):
        z[index] = row[index]
    for index in range(CONTACTS):
        modes[index] = int(row[STATE_SIZE + index])
    for index in range(len(states)):
        states[index] = row[STATE_SIZE + CONTACTS + index]
