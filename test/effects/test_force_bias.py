"""Force bias: a command that nobody gave."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from motion import drive, drives, forces, models, numbers, push

from diffbot_sim.physics import Friction, Model
from diffbot_sim.physics.effects.force_bias import ForceBias

SMOOTH = Friction('none')
STATIC = Friction().law().static


@given(right=forces(5.0), left=forces(5.0))
def test_free_robot_accelerates_without_a_command(right, left):
    model = Model(friction=SMOOTH, effects=(ForceBias(right, left),))
    run, robot = push(model, 0.0, 0.0, 2.0), model.robot
    v = (right + left) / robot.mass * run.time
    omega = robot.half_separation * (right - left) / robot.inertia * run.time
    np.testing.assert_allclose(run.twist, np.column_stack([v, omega]), rtol=1e-9, atol=1e-9)


@given(model=models(), rows=drives(), right=forces(20.0), left=forces(20.0))
def test_bias_is_a_change_of_every_command_to_the_last_bit(model, rows, right, left):
    biased = drive(model.with_effect(ForceBias(right, left)), *rows, until=2.5)
    raised = [(time, a + right, b + left) for time, a, b in rows]
    np.testing.assert_array_equal(biased.pose, drive(model, *raised, until=2.5).pose)


@given(share=numbers(-0.99, 0.99))
def test_static_friction_holds_a_bias_up_to_its_limit(share):
    run = push(Model(effects=(ForceBias(share * STATIC, share * STATIC),)), 0.0, 0.0, 5.0)
    assert not run.pose.any()
    np.testing.assert_allclose(run.friction, share * STATIC, rtol=1e-12)


@pytest.mark.parametrize('sign', [1.0, -1.0])
@given(excess=st.floats(1.001, 3.0))
def test_larger_bias_sets_the_robot_in_motion(sign, excess):
    bias = sign * excess * STATIC
    assert sign * push(Model(effects=(ForceBias(bias, bias),)), 0.0, 0.0, 1.0).pose[-1, 0] > 0.0
