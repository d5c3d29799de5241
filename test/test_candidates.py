"""Candidates fitted to the end: what they end at must not hang on where they begin."""

from dataclasses import replace

import numpy as np
from fits import fitted

from diffbot_sim.control.rehearsal import Surroundings, random_forces, rehearse
from diffbot_sim.identification.selection.candidates import approach, complete
from diffbot_sim.identification.selection.rivals import INDISTINGUISHABLE
from diffbot_sim.identification.selection.screening import Screen
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects.direction_dependent_friction import DirectionDependentFriction

# Pushes that change fast, and a noise model that takes them for slow ones.
FAST = Surroundings(v_noise=0.008, omega_noise=0.012, roughness=0.5, memory=0.05)
SLOW = np.array([0.15, 0.002, 0.999, 0.15, 0.002, 0.999])


def test_fit_does_not_stay_with_a_noise_model_that_made_up_for_what_was_missing() -> None:
    robot = Model(effects=(DirectionDependentFriction(0.15, 0.15),))
    fit, _ = fitted(rehearse(robot, random_forces(2, 60.0, -9.0, 11.0), FAST, 2))
    screen = Screen(fit)
    near = approach(screen, DirectionDependentFriction, screen.score(DirectionDependentFriction))
    ends = [complete(start).deviance(fit.sigma) for start in (near, replace(near, gains=SLOW))]
    assert ends[1] < ends[0] + INDISTINGUISHABLE
