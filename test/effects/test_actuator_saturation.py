"""actuator_saturation: no more than the limit acts, either way."""

import numpy as np
import pytest
from motion import push

from diffbot_sim.physics import Model
from diffbot_sim.physics.effects.actuator_saturation import ActuatorSaturation
from diffbot_sim.physics.effects.effect import Excitation


@pytest.mark.parametrize(('asked', 'given'), [(8.0, 5.0), (-8.0, -5.0), (3.0, 3.0), (-5.0, -5.0)])
def test_force_is_clipped_at_the_limit(asked, given):
    run = push(Model(effects=(ActuatorSaturation(5.0),)), asked, asked, 1.0)
    np.testing.assert_array_equal(run.traction, given)


def test_each_wheel_has_the_limit_of_its_own():
    run = push(Model(effects=(ActuatorSaturation(5.0),)), 9.0, 2.0, 1.0)
    np.testing.assert_array_equal(run.traction[-1], (5.0, 2.0))


def test_fits_start_below_the_largest_command():
    starts = ActuatorSaturation.starts(Excitation(40.0, 60.0))
    assert all(0.0 < limit < 40.0 for (limit,) in starts)
