"""A robot whose motion does not follow the forces that were recorded."""

from dataclasses import replace

import numpy as np
import pytest
from fits import fitted
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.identification import identify
from diffbot_sim.identification.following import follows_nothing
from diffbot_sim.identification.recordings.stretches import split
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects.slope import Slope
from diffbot_sim.records import Commands, Run

FORCES = random_forces(3, 60.0, -9.0, 11.0)


def driven(roughness: float = 0.0) -> Run:
    return rehearse(Model(), FORCES, Surroundings(roughness=roughness), 3)


def by_another_clock(run: Run, late: float) -> Run:
    """Return a run whose forces are stamped late [s]."""
    given = Commands(run.commands.time + late, run.commands.force)
    return replace(run, commands=given)


@pytest.mark.parametrize('roughness', [0.0, 0.3])
def test_robot_that_moves_as_it_is_driven_follows_its_forces(roughness: float) -> None:
    fit, held_out = fitted(driven(roughness))
    assert follows_nothing(fit, held_out) is None


def test_forces_of_another_clock_are_not_said_to_suffice() -> None:
    answer = identify([by_another_clock(driven(), 7.0)], Model(), kinds=[Slope])
    assert answer.verdict == 'unexplained'
    assert answer.unexplained is not None


def test_what_moves_by_itself_is_told_with_what_to_look_at() -> None:
    learned, held_out = split([replace(driven(), commands=still())])
    fit, _ = fitted(driven())
    left = follows_nothing(replace(fit, stretches=learned), held_out)
    assert left is not None
    assert 'clocks, topics and units' in left.description


def still() -> Commands:
    """Return commands of next to nothing."""
    return Commands(FORCES.time, np.full_like(FORCES.force, 1e-3))
