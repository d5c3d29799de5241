"""transmission_loss: a driving gear gives 1 - loss of the force, a braking one 1 + loss."""

import numpy as np
import pytest
from motion import push

from diffbot_sim.physics import Friction, Model
from diffbot_sim.physics.effects.payload_change import PayloadChange
from diffbot_sim.physics.effects.transmission_loss import TransmissionLoss
from diffbot_sim.physics.state import State

LOSS = 0.2


@pytest.mark.parametrize(('force', 'share'), [(3.0, 1.0 - LOSS), (-3.0, 1.0 + LOSS)])
def test_gear_loses_when_it_drives_and_helps_when_it_brakes(force, share):
    model = Model(friction=Friction('none'), effects=(TransmissionLoss(LOSS),))
    run = push(model, force, force, 1.0, start=State(v=2.0))
    expected = 2.0 + share * 2.0 * force / model.robot.mass * run.time
    np.testing.assert_allclose(run.twist[:, 0], expected, rtol=1e-9)


def test_wheel_at_rest_needs_more_force_to_break_away():
    model = Model(
        friction=Friction('coulomb', 50.0, mu_coulomb=0.04), effects=(TransmissionLoss(LOSS),)
    )
    needed = 2.0 / (1.0 - LOSS)
    stuck, gone = (push(model, f, f, 1.0) for f in (0.99 * needed, 1.01 * needed))
    assert not stuck.twist.any()
    assert gone.twist[-1, 0] > 0.0


def test_weight_of_a_load_does_not_change_what_a_gear_loses():
    load = PayloadChange(10.0, 0.2, 0.0, friction_share=1.0)
    model = Model(friction=Friction('none'), effects=(TransmissionLoss(0.5), load))
    run = push(model, 3.0, 3.0, 1.0)
    mass = model.robot.mass + load.mass
    np.testing.assert_allclose(run.twist[:, 0], 0.5 * 6.0 / mass * run.time, atol=1e-9)
