"""Candidates: how a structure with one effect more is fitted."""

from dataclasses import replace

import numpy as np
import pytest
from fits import SMOOTH, fitted

from diffbot_sim.control.rehearsal import random_forces, rehearse
from diffbot_sim.identification.fitting.coordinates import Space
from diffbot_sim.identification.selection.candidates import approach, from_afresh
from diffbot_sim.identification.selection.screening import Screen
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects.actuator_lag import ActuatorLag


def test_fit_that_ended_in_a_hollow_is_begun_afresh() -> None:
    hidden = Model(effects=(ActuatorLag(time_constant=0.15),))
    plain, _ = fitted(rehearse(hidden, random_forces(1, 40.0, -9.0, 11.0), SMOOTH, 1))
    space = Space(Model(), (ActuatorLag,))
    in_a_hollow = replace(plain, space=space, u=np.append(plain.u, 0.6))
    screen = Screen(plain)
    near = approach(screen, ActuatorLag, screen.score(ActuatorLag))
    found = from_afresh(near, in_a_hollow)
    assert found.model.effects[0].time_constant == pytest.approx(0.15, rel=0.02)
