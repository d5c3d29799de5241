"""Candidates: how a structure with one effect more is fitted."""

from dataclasses import replace

import numpy as np
import pytest
from fits import SMOOTH, fitted
from rehearsal import random_forces, rehearse

from diffbot_sim.identification.fitting.coordinates import Space
from diffbot_sim.identification.fitting.fit import GAIN_LIMITS
from diffbot_sim.identification.selection.candidates import complete
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects.actuator_lag import ActuatorLag


def test_noise_model_that_follows_nearly_all_leads_no_fit_into_a_hollow() -> None:
    hidden = Model(effects=(ActuatorLag(time_constant=0.15),))
    plain, _ = fitted(rehearse(hidden, random_forces(1, 40.0, -9.0, 11.0), SMOOTH, 1))
    space, (_, most) = Space(Model(), (ActuatorLag,)), GAIN_LIMITS
    near = replace(plain, space=space, u=np.append(plain.u, 0.2), gains=most)
    assert complete(near).model.effects[0].time_constant == pytest.approx(0.15, rel=0.02)
