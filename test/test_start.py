"""The first state of a stretch: at rest where that may be, in motion where it is not."""

from dataclasses import replace

import numpy as np
import pytest
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.identification.recordings.start import start_of
from diffbot_sim.identification.recordings.stretches import Stretch, whole
from diffbot_sim.physics import Model, Robot
from diffbot_sim.physics.effects.effective_track import EffectiveTrack
from diffbot_sim.records import Commands, Run

HEAVY = Model(Robot(mass=13.0, inertia=0.3))
STEP = 0.005


def begun_at(moment: float, noise: float) -> Stretch:
    """Return what follows a moment [s] of a drive, as a stretch."""
    quiet = Surroundings(v_noise=noise, omega_noise=noise)
    run = rehearse(Model(), random_forces(1, 20.0, -9.0, 11.0), quiet, 1)
    return whole([after(run, moment)])[0]


def after(run: Run, moment: float) -> Run:
    """Return a run without the odometry before a moment."""
    later = run.odometry.time >= moment
    time, twist = run.odometry.time[later], run.odometry.twist[later]
    return replace(run, odometry=replace(run.odometry, time=time, twist=twist, pose=None))


@pytest.mark.parametrize('noise', [0.0, 1e-4, 4e-3])
@pytest.mark.parametrize('model', [Model(), HEAVY], ids=['true', 'wrong'])
def test_robot_that_moves_fast_does_not_start_at_rest(model: Model, noise: float) -> None:
    stretch = begun_at(12.0, noise)
    assert start_of(model, stretch, STEP).v == pytest.approx(stretch.twist[0, 0], rel=0.2)


def test_robot_that_rests_starts_at_rest_exactly() -> None:
    start = start_of(HEAVY, begun_at(0.0, 4e-3), STEP)
    assert (start.v, start.omega) == (0.0, 0.0)


@pytest.mark.parametrize('push', [20.0, 30.0])
def test_robot_that_is_thrown_back_at_once_starts_as_it_moved_before(push: float) -> None:
    model, time = Model(effects=(EffectiveTrack(0.12),)), np.arange(0.0, 8.0, 0.02)
    force = np.zeros((len(time), 2))
    # It begins to turn on the spot, is pushed back while it does, and rolls on.
    for since, both in ((4.7, (-3.0, 3.0)), (5.0, (-1.6, 1.6)), (5.13, (-push, -0.8 * push))):
        force[time >= since] = both
    force[time >= 5.33] = (-3.5, -2.5)
    run = rehearse(model, Commands(time, force), Surroundings(), 1)
    (stretch,) = whole([after(run, 5.0)])
    start = start_of(model, stretch, STEP)
    assert (start.v, start.omega) == pytest.approx(stretch.twist[:5].mean(axis=0), abs=0.02)
