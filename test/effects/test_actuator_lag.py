"""Actuator lag: exponential approach."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from motion import commands, numbers

from diffbot_sim.physics import Model, simulate
from diffbot_sim.physics.effects.actuator_lag import ActuatorLag


@given(tau=st.floats(0.01, 1.0), right=numbers(-20.0, 20.0), left=numbers(-20.0, 20.0))
def test_lagging_force_approaches_the_command_exponentially(tau, right, left):
    times = np.linspace(-0.1, 1.0, 56)
    rows = commands((-1.0, 0.0, 0.0), (0.0, right, left))
    run = simulate(Model(effects=(ActuatorLag(tau),)), rows, times)
    rise = np.where(times > 0.0, 1.0 - np.exp(-np.maximum(times, 0.0) / tau), 0.0)
    np.testing.assert_allclose(run.traction, np.outer(rise, (right, left)), atol=1e-10)
