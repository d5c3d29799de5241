"""Names are there to be simulated: one that makes that worse is withdrawn."""

from dataclasses import replace
from functools import cache

import identification_by_hand as by_hand
import numpy as np
from fits import SMOOTH, SURE, fitted
from rehearsal import random_forces, rehearse

from diffbot_sim.identification.fitting.coordinates import Space, point_of
from diffbot_sim.identification.fitting.fit import FIRST_GAINS, fit_prediction
from diffbot_sim.identification.found import Found
from diffbot_sim.identification.recordings.free_running import free_running_error
from diffbot_sim.identification.recordings.recordings import Recordings
from diffbot_sim.identification.selection.stepwise import Selection
from diffbot_sim.identification.selection.trials import SUPPORTED, WORSENING, Trial
from diffbot_sim.identification.simulating import WORSE, without_worsening
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects import Effect
from diffbot_sim.physics.effects.quadratic_drag import QuadraticDrag
from diffbot_sim.physics.effects.slope import Slope
from diffbot_sim.physics.effects.wheel_ripple import WheelRipple
from diffbot_sim.records import Run

RIPPLE = WheelRipple(order=6.0, right_cos=2.0, left_cos=2.0)


@cache
def driven(*hidden: Effect) -> Run:
    """Return a drive of a robot that has these effects."""
    return rehearse(Model(effects=hidden), random_forces(1, 40.0, -9.0, 11.0), SMOOTH, 1)


@cache
def held_against(named: Effect, *acting: Effect) -> Found:
    """Return an effect found where it acts, beside held-out data in which these act."""
    return found_beside(named, driven(named), driven(*acting))


def found_beside(named: Effect, run: Run, other: Run) -> Found:
    """Return an effect found in a run, beside held-out data of another one."""
    plain, _ = fitted(run)
    space = Space(Model(), (type(named),))
    start = np.concatenate([plain.u, point_of(type(named), named.values)])
    fit = fit_prediction(space, plain.stretches, start, FIRST_GAINS)
    trial, name = Trial(type(named), fit, SURE, SUPPORTED), named.name
    selection = Selection(plain, fit, (trial,), {name: plain}, {name: SURE}, {name: ()})
    _, held_out = fitted(other)
    recordings, left = Recordings((run,), ()), by_hand.unexplained().unexplained
    return Found(recordings, held_out, plain, selection, selection, left)


def slope_held_against(grade: float) -> Found:
    """Return a slope found on a floor that rises, and held out a floor that rises by so much."""
    return held_against(Slope(grade_x=0.02), Slope(grade_x=grade))


def test_name_that_makes_the_simulation_worse_is_withdrawn() -> None:
    left = without_worsening(slope_held_against(-0.02))
    assert left.names == frozenset()
    assert left.unexplained is not None
    assert left.selection.trials[0].outcome == WORSENING


def test_name_that_makes_the_simulation_better_stays() -> None:
    found = slope_held_against(0.02)
    assert without_worsening(found) is found


def test_ripple_that_gets_out_of_step_stays() -> None:
    found = held_against(RIPPLE, RIPPLE, Slope(grade_x=0.01))
    fits = found.selection.final, found.selection.base
    named, without = (free_running_error(fit.model, found.held_out) for fit in fits)
    assert np.max(named / without) > WORSE
    assert without_worsening(found) is found


def test_name_of_a_robot_that_never_turns_stays() -> None:
    forces = random_forces(1, 40.0, -9.0, 11.0)
    straight = replace(forces, force=forces.force[:, :1].repeat(2, axis=1))
    drag, around = QuadraticDrag(2.0), replace(SMOOTH, omega_noise=0.0)
    run = rehearse(Model(effects=(drag,)), straight, around, 1)
    found = found_beside(drag, run, run)
    assert without_worsening(found) is found


def test_nothing_is_held_against_a_name_where_all_is_explained() -> None:
    complete = replace(slope_held_against(-0.02), unexplained=None)
    assert without_worsening(complete) is complete


def test_nothing_is_allowed_for_beside_a_name_that_is_withdrawn():
    allowing = replace(slope_held_against(-0.02), unexplained=None, near_rest=50.0)
    left = without_worsening(allowing)
    assert left.names == frozenset()
    assert left.unexplained is not None
    assert left.near_rest == 0.0
