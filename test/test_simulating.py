"""Names are there to be simulated: one that makes that worse is withdrawn."""

from dataclasses import replace
from functools import cache

import identification_by_hand as by_hand
from fits import SMOOTH, fitted

from diffbot_sim.control.rehearsal import random_forces, rehearse
from diffbot_sim.identification.fitting.coordinates import Space
from diffbot_sim.identification.fitting.fit import FIRST_GAINS, fit_prediction
from diffbot_sim.identification.found import Found
from diffbot_sim.identification.recordings.recordings import Recordings
from diffbot_sim.identification.selection.evidence import Evidence
from diffbot_sim.identification.selection.stepwise import Selection
from diffbot_sim.identification.selection.trials import SUPPORTED, WORSENING, Trial
from diffbot_sim.identification.simulating import without_worsening
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects.slope import Slope
from diffbot_sim.records import Run

SURE = Evidence(90.0, 0.0, 0.0, 0.1, 0.0, 0.0)


@cache
def driven(grade: float) -> Run:
    """Return a drive on a floor that rises along x by so much."""
    hidden = Model(effects=(Slope(grade_x=grade),))
    return rehearse(hidden, random_forces(1, 40.0, -9.0, 11.0), SMOOTH, 1)


@cache
def slope_held_against(grade: float) -> Found:
    """Return a slope found on a floor that rises, and held out a floor that rises by so much."""
    plain, _ = fitted(driven(0.02))
    space = Space(Model(), (Slope,))
    named = fit_prediction(space, plain.stretches, space.prior(), FIRST_GAINS)
    trial = Trial(Slope, named, SURE, SUPPORTED)
    selection = Selection(plain, named, (trial,), {'slope': plain}, {'slope': SURE}, {'slope': ()})
    _, held_out = fitted(driven(grade))
    recordings = Recordings((driven(0.02),), ())
    return Found(
        recordings, held_out, plain, selection, selection, by_hand.unexplained().unexplained
    )


def test_name_that_makes_the_simulation_worse_is_withdrawn() -> None:
    left = without_worsening(slope_held_against(-0.02))
    assert left.names == frozenset()
    assert left.unexplained is not None
    assert left.selection.trials[0].outcome == WORSENING


def test_name_that_makes_the_simulation_better_stays() -> None:
    found = slope_held_against(0.02)
    assert without_worsening(found) is found


def test_nothing_is_held_against_a_name_where_all_is_explained() -> None:
    complete = replace(slope_held_against(-0.02), unexplained=None)
    assert without_worsening(complete) is complete
