"""Robots that seem late because a controller hears more than was recorded."""

from dataclasses import replace

import numpy as np
from fits import ROUGH, acted_otherwise
from rehearsal import random_forces

from diffbot_sim.identification.fitting.coordinates import Space
from diffbot_sim.identification.fitting.fit import FIRST_GAINS, Fit, fit_prediction
from diffbot_sim.identification.recordings.stretches import split
from diffbot_sim.identification.selection.feedback import is_of_feedback
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects.actuator_delay import ActuatorDelay
from diffbot_sim.physics.effects.slope import Slope
from diffbot_sim.records import Array

JUMPS = random_forces(5, 80.0, -9.0, 11.0)
SMALL = 0.4 * np.random.default_rng(5).normal(size=JUMPS.force.shape)
LATE = 2  # samples


def late(force: Array) -> Array:
    """Return forces as they act when they are late."""
    return np.vstack([np.zeros((LATE, 2)), force[:-LATE]])


def fitted(acting: Array) -> Fit:
    """Return the fit of a robot with a delay where these forces act in place of those recorded."""
    commands = replace(JUMPS, force=JUMPS.force + SMALL)
    space = Space(Model(), (ActuatorDelay,))
    learned, _ = split([acted_otherwise(commands, acting, ROUGH)])
    start = space.prior()
    start[space.places('actuator_delay')] = 0.5
    return fit_prediction(space, learned, start, FIRST_GAINS)


def test_robot_that_is_late_only_while_forces_hardly_change_is_not_late() -> None:
    fit = fitted(JUMPS.force + late(SMALL))
    assert fit.model.effects
    assert is_of_feedback(fit, 'actuator_delay')


def test_robot_that_is_late_when_forces_jump_is_late() -> None:
    assert not is_of_feedback(fitted(late(JUMPS.force + SMALL)), 'actuator_delay')


def test_other_effects_are_not_suspected_of_it() -> None:
    fit = fitted(JUMPS.force + late(SMALL))
    assert not is_of_feedback(fit, Slope.name)
