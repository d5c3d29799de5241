"""Friction near rest is allowed for: what that excuses, and which names it gives back."""

from dataclasses import replace
from functools import cache

import identification_by_hand as by_hand
import pytest
from fits import SMOOTH, SURE, fitted
from rehearsal import random_forces, rehearse

from diffbot_sim.identification.allowing import excuses, gives_back
from diffbot_sim.identification.doubt import Doubted
from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.found import Found
from diffbot_sim.identification.recordings.recordings import Recordings
from diffbot_sim.identification.result import Structure
from diffbot_sim.identification.selection.stepwise import Selection
from diffbot_sim.identification.suspicion import SUSPICIOUS
from diffbot_sim.physics import Model

MUCH = 4.0 * SUSPICIOUS


@cache
def plain() -> Fit:
    """Return the fit of a drive that lacks nothing."""
    return fitted(rehearse(Model(), random_forces(1, 20.0, -9.0, 11.0), SMOOTH, 1))[0]


def named(*names: str) -> Selection:
    """Return a selection that has these names."""
    return Selection(plain(), plain(), (), {}, dict.fromkeys(names, SURE), {})


def left(worth: float) -> Structure | None:
    """Return something unexplained of this worth."""
    structure = by_hand.unexplained().unexplained
    return structure and replace(structure, worth=worth)


def found(worth: float, *names: str) -> Found:
    """Return what was found with these names, and something unexplained beside them."""
    selection = named(*names)
    return Found(Recordings((), ()), (), plain(), selection, selection, left(worth))


def test_friction_near_rest_that_explains_more_excuses_what_was_left():
    assert excuses(Doubted(named(), None, MUCH), found(0.9 * MUCH))
    assert not excuses(Doubted(named(), None, MUCH), found(1.1 * MUCH))


def test_what_a_name_explains_that_stands_only_then_needs_no_excuse():
    assert excuses(Doubted(named('slope'), None, MUCH), found(1.1 * MUCH))


def test_friction_that_leaves_something_to_be_told_excuses_nothing():
    assert not excuses(Doubted(named(), left(1.0), MUCH), found(0.9 * MUCH))


def test_name_that_went_for_the_form_of_friction_is_given_back():
    assert gives_back(Doubted(named('slope'), left(50.0), MUCH), found(100.0))


@pytest.mark.parametrize(
    ('worth', 'near_rest', 'stood'),
    [
        (150.0, MUCH, ()),
        (50.0, 0.9 * SUSPICIOUS, ()),
        (50.0, MUCH, ('slope',)),
        (50.0, MUCH, ('com_offset',)),
    ],
    ids=['more is left', 'friction of chance', 'it stood', 'another one stood'],
)
def test_no_name_is_given_back_where(worth, near_rest, stood):
    doubted = Doubted(named('slope'), left(worth), near_rest)
    assert not gives_back(doubted, found(100.0, *stood))
