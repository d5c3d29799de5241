"""A slope beside a heading that drifts."""

from dataclasses import replace

import numpy as np
import pytest
from fits import fitted
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.free_forms.bases import bases
from diffbot_sim.identification.free_forms.dependence import Dependence, explained_by
from diffbot_sim.identification.free_forms.drifting import is_of_drift
from diffbot_sim.identification.selection.screening import Screen
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects import Effect
from diffbot_sim.physics.effects.slope import Slope


def changing_pull(fit: Fit, size: float) -> Dependence:
    """Return a pull that changes, of a root mean square [N]."""
    basis = next(b for b in bases(fit, fit.stretches) if b.variable == 'pull')
    left = explained_by(Screen(fit), basis)
    return replace(left, amounts=left.amounts * size / basis.strength(left.amounts))


def fit_of(effects: tuple[Effect, ...]) -> Fit:
    model = Model(effects=effects)
    run = rehearse(model, random_forces(3, 60.0, -9.0, 11.0), Surroundings(), 3)
    return fitted(run, model)[0]


@pytest.mark.parametrize(('size', 'is_drift'), [(0.003, True), (0.1, False)])
def test_pull_is_of_drift_where_that_is_as_large(size: float, is_drift: bool) -> None:
    """Noise of 8 mrad/s at 50 Hz adds up to 7 mrad; the slope pulls with 2 N."""
    fit = fit_of((Slope(0.02, 0.0),))
    assert is_of_drift(changing_pull(fit, size), fit) == is_drift


def test_nothing_is_of_drift_on_the_level() -> None:
    fit = fit_of(())
    assert not is_of_drift(changing_pull(fit, 1e-6), fit)


def test_other_dependences_are_not_of_drift() -> None:
    fit = fit_of((Slope(0.02, 0.0),))
    others = [b for b in bases(fit, fit.stretches) if b.variable != 'pull'][:5]
    left = [explained_by(Screen(fit), basis) for basis in others]
    assert not any(is_of_drift(replace(d, amounts=np.zeros_like(d.amounts)), fit) for d in left)
