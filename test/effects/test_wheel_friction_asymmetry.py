"""Wheel friction asymmetry: the robot veers."""

import pytest
from motion import push

from diffbot_sim.physics import Model
from diffbot_sim.physics.effects.wheel_friction_asymmetry import WheelFrictionAsymmetry


@pytest.mark.parametrize('effect', [{'dry': 0.2}, {'viscous': 0.2}])
@pytest.mark.parametrize('sign', [1.0, -1.0])
def test_robot_veers_to_the_side_that_rubs_more(effect, sign):
    """Positive asymmetry burdens the right wheel, and a right turn has ω < 0."""
    asymmetry = WheelFrictionAsymmetry(**{name: sign * x for name, x in effect.items()})
    run = push(Model(effects=(asymmetry,)), 5.0, 5.0, 5.0)
    assert (sign * run.twist[5:, 1] < 0.0).all()
