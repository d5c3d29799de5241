"""The noise of a robot that stands: whether it went through a filter, and when it does stand."""

from dataclasses import replace

import numpy as np
import pytest
from rehearsal import Surroundings, random_forces, rehearse
from scipy.signal import lfilter

from diffbot_sim.identification.fitting.coordinates import Space
from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.fitting.predictor import NO_GAIN
from diffbot_sim.identification.fitting.standing_noise import (
    denied_at_rest,
    rests_of,
    standing_noise,
)
from diffbot_sim.identification.recordings.filters import FirstOrder, told_each_sample
from diffbot_sim.identification.recordings.stretches import split
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects import Effect
from diffbot_sim.physics.effects.actuator_lag import ActuatorLag
from diffbot_sim.physics.effects.slope import Slope
from diffbot_sim.records import Run

NOISE = Surroundings(0.008, 0.016)


def driven(*effects: Effect) -> Run:
    """Return a minute of random forces, with stops."""
    return rehearse(Model(effects=effects), random_forces(3, 60.0, -9.0, 11.0), NOISE, 3)


def declared(run: Run) -> Fit:
    """Return the declared model on a run, as it stands: nothing is fitted."""
    space = Space(Model(), ())
    return Fit(space, split([run])[0], space.prior(), NO_GAIN, np.ones(2))


@pytest.mark.parametrize('went_through', [True, False])
def test_noise_at_rest_denies_a_filter_that_it_did_not_go_through(went_through: bool) -> None:
    run, behind = driven(ActuatorLag(0.06)), FirstOrder(0.02, told_each_sample)
    if went_through:
        seen, share = run.odometry, behind.at_once(0.02)
        passed = lfilter([share], [1.0, share - 1.0], seen.twist, axis=0)
        run = replace(run, odometry=replace(seen, twist=passed, pose=None))
    assert denied_at_rest(declared(run), behind) == (not went_through)


def test_where_twists_tell_of_motion_no_robot_stands() -> None:
    free = declared(driven(Slope(0.04, 0.04)))
    noise = standing_noise(free.stretches, rests_of(free))
    assert len(noise) > 1
    assert np.concatenate(noise).std(axis=0) == pytest.approx([0.008, 0.016], rel=0.3)
