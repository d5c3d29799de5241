"""Direction-dependent friction: two terminal speeds."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from motion import push

from diffbot_sim.physics import Friction, Model
from diffbot_sim.physics.effects.direction_dependent_friction import DirectionDependentFriction


@given(dry=st.floats(-0.5, 0.5), viscous=st.floats(-0.5, 0.5))
def test_direction_dependent_friction_sets_two_terminal_speeds(dry, viscous):
    friction = Friction('coulomb_viscous')
    law = friction.law()
    effect = DirectionDependentFriction(dry, viscous)
    model = Model(friction=friction, effects=(effect,))
    for way in (1.0, -1.0):
        run = push(model, way * 8.0, way * 8.0, 60.0, every=1.0, max_step=0.02)
        coulomb, damping = law.coulomb * (1 + way * dry), law.viscous * (1 + way * viscous)
        assert run.twist[-1, 0] == pytest.approx(way * (8.0 - coulomb) / damping, rel=1e-6)
