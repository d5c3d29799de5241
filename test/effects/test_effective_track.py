"""Effective track: another wheel separation, and what a gyro of another scale shows."""

from dataclasses import replace

import numpy as np
from motion import push

from diffbot_sim.physics import Model
from diffbot_sim.physics.effects.effective_track import EffectiveTrack
from diffbot_sim.physics.state import State

START = State(v=0.4, omega=-1.0)


def driven(model: Model, start: State = START) -> np.ndarray:
    """Return the twist of a drive that stops one wheel."""
    return push(model, 3.0, 1.5, 4.0, start=start).twist


def test_wider_track_is_a_wider_robot():
    wide = Model()
    wide = replace(wide, robot=replace(wide.robot, wheel_separation=0.48))
    np.testing.assert_allclose(
        driven(Model(effects=(EffectiveTrack(0.2),))), driven(wide), rtol=1e-9, atol=1e-12
    )


def test_gyro_that_shows_too_much_looks_like_a_narrower_track():
    share, robot = 0.1, Model().robot
    told = driven(Model()) * [1.0, 1.0 + share]
    light = replace(robot, inertia=robot.inertia / (1.0 + share) ** 2)
    narrow = Model(robot=light, effects=(EffectiveTrack(-share / (1.0 + share)),))
    start = replace(START, omega=START.omega * (1.0 + share))
    np.testing.assert_allclose(driven(narrow, start), told, rtol=1e-9, atol=1e-12)
