"""The empirical term: what is left without a name, put into the model as a table."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from diffbot_sim.identification.comparison import norm, run_free
from diffbot_sim.identification.fitting import Fit, fit_prediction
from diffbot_sim.identification.result import Structure
from diffbot_sim.identification.stretches import Stretch
from diffbot_sim.physics.effects.empirical_force import AXES, POINTS, VARIABLES, EmpiricalForce
from diffbot_sim.physics.model import Model

# The term is kept when it lowers the held-out error, v and ω together, by this share.
WORTHWHILE = 0.02


def with_term(fit: Fit, structure: Structure, held_out: Sequence[Stretch]) -> Fit | None:
    """Return the fit with the structure as a table in its model, if that simulates better.

    Judged by the free-running error on held-out data; None where no effect can look at the
    variable, or where the error does not fall.
    """
    if structure.variable not in VARIABLES or structure.axis not in AXES:
        return None
    declared = fit.space.declared.with_effect(table_of(structure))
    space = replace(fit.space, declared=declared)
    trial = fit_prediction(space, fit.stretches, fit.u, fit.gains, evaluations=10, rounds=2)
    before, after = (_error(model, held_out) for model in (fit.model, trial.model))
    return trial if after < before + np.log(1.0 - WORTHWHILE) else None


def table_of(structure: Structure) -> EmpiricalForce:
    """Return the curve of a structure as the table that the simulator runs."""
    low, high = float(structure.knots[0]), float(structure.knots[-1])
    places = np.linspace(low, high, POINTS)
    points = [float(f) for f in np.interp(places, structure.knots, structure.force)]
    return EmpiricalForce(structure.axis, structure.variable, low, high, *points)


def _error(model: Model, held_out: Sequence[Stretch]) -> float:
    """Return the mean logarithm of the held-out errors of v and ω."""
    misses = [stretch.twist - run_free(model, stretch).twist for stretch in held_out]
    both = norm(np.concatenate(misses))
    return float(np.log([both.v_rmse, both.omega_rmse]).mean())
