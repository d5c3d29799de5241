"""What sets in where runs are held out."""

from functools import cache

import pytest
from fits import fitted
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.identification import identify
from diffbot_sim.identification.later import sets_in_later
from diffbot_sim.identification.recordings.recordings import Recordings
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects.payload_change import PayloadChange
from diffbot_sim.records import Run

MOMENT, KINDS = 44.5, (PayloadChange,)


@cache
def loaded(mass: float) -> Run:
    """Return a minute's drive, 70 % of which is fitted, with a load that is put on after that."""
    robot = Model(effects=(PayloadChange(mass, 0.02 * mass, MOMENT),))
    return rehearse(robot, random_forces(5, 60.0, -9.0, 11.0), Surroundings(), 5)


def test_load_that_is_put_on_where_runs_are_held_out_is_named() -> None:
    answer = identify([loaded(4.0)], Model(), kinds=KINDS)
    assert ([e.name for e in answer.effects], answer.unexplained) == (['payload_change'], None)
    moment = answer.effects[0].parameters['moment']
    assert moment.low < MOMENT < moment.high


@pytest.mark.parametrize(('mass', 'seen'), [(0.0, False), (1.5, True)])
def test_effect_that_is_tried_there_enters_if_it_is_there(mass: float, seen: bool) -> None:
    base, _ = fitted(run := loaded(mass))
    assert sets_in_later(base, Recordings((run,), ()), KINDS, print) == seen
