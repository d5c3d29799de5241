"""What is said of a spot of the floor must hold whenever the robot comes back."""

from dataclasses import replace

import numpy as np
import pytest
from fits import acted_otherwise, fitted
from rehearsal import Surroundings, rehearse

from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.free_forms.bases import again, bases
from diffbot_sim.identification.free_forms.dependence import Dependence, explained_by, realised
from diffbot_sim.identification.free_forms.returning import is_denied_on_return
from diffbot_sim.identification.selection.screening import Screen
from diffbot_sim.physics import Model
from diffbot_sim.records import Array, Commands

TIME = np.arange(0.0, 60.0, 0.02)
TO_AND_FRO = Commands(TIME, 5.0 * np.sign(np.sin(0.6 * TIME))[:, None] * np.ones(2))


def visits() -> Array:
    """Return the number of the visit to the middle of the way at each command, 0 between them."""
    run = rehearse(Model(), TO_AND_FRO, Surroundings(), 3)
    x = np.interp(TIME, run.odometry.time, run.odometry.pose[:, 0])
    there = np.abs(x - np.median(x)) < 0.1 * np.ptp(x)
    return np.where(there, np.cumsum(np.diff(there, prepend=False) & there), 0)


def weakened(where: Array) -> Fit:
    """Return a plain fit of a robot whose wheels get a part of their force there."""
    force = TO_AND_FRO.force * np.where(where, 0.7, 1.0)[:, None]
    fit, _ = fitted(acted_otherwise(TO_AND_FRO, force))
    return fit


@pytest.fixture(scope='module')
def spot() -> Dependence:
    """A spot of the floor that acts on every visit."""
    fit = weakened(visits() > 0)
    screen, spots = Screen(fit), bases(fit, fit.stretches, ['force_over_patch'])
    tried = [realised(fit, explained_by(screen, basis)) for basis in spots]
    return max(tried, key=lambda spot: spot.fall)


def test_spot_that_acts_on_every_visit_is_not_denied(spot: Dependence) -> None:
    assert not is_denied_on_return(weakened(visits() > 0), spot)


@pytest.mark.parametrize('visit', [3, 4, 5])
def test_spot_that_acted_but_once_is_denied(spot: Dependence, visit: int) -> None:
    fit = weakened(visits() == visit)
    basis = again(spot.basis, fit, fit.stretches)
    assert is_denied_on_return(fit, replace(spot, basis=basis))
