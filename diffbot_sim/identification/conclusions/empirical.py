"""The empirical term: what is left without a name, put into the model as a table."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from diffbot_sim.identification.conclusions.comparison import free_running_error
from diffbot_sim.identification.fitting.fit import Fit, fit_simulation
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.result import Structure
from diffbot_sim.physics.effects import empirical_force, empirical_wheel_force
from diffbot_sim.physics.effects.empirical_force import POINTS, EmpiricalForce
from diffbot_sim.physics.effects.empirical_wheel_force import EmpiricalWheelForce
from diffbot_sim.physics.model import Model

# What the table of a structure runs over, where that is not the structure's own variable.
TABLE_OF = {'constant': 'time', 'rolling': 'wheel_speed', 'turning': 'omega'}
# The term is kept when it lowers the held-out error, v and ω together, by this share.
WORTHWHILE = 0.02


def with_term(fit: Fit, structure: Structure, held_out: Sequence[Stretch]) -> Fit | None:
    """Return the fit with the structure as a table in its model, if that simulates better.

    Judged by the free-running error on held-out data; None where no table can look at the
    variable, or where the error does not fall.
    """
    table = table_of(structure)
    if table is None:
        return None
    space = replace(fit.space, declared=fit.space.declared.with_effect(table))
    trial = fit_simulation(space, fit.stretches, fit.u)
    before, after = (_error(model, held_out) for model in (fit.model, trial.model))
    return trial if after < before + np.log(1.0 - WORTHWHILE) else None


def table_of(structure: Structure) -> EmpiricalForce | EmpiricalWheelForce | None:
    """Return the curve of a structure as a table that the simulator runs, if there is such one."""
    axis, variable = structure.axis, TABLE_OF.get(structure.variable, structure.variable)
    if axis in empirical_force.AXES and variable in empirical_force.VARIABLES:
        return EmpiricalForce(axis, variable, *_points(structure))
    if axis in empirical_wheel_force.AXES and variable in empirical_wheel_force.VARIABLES:
        return EmpiricalWheelForce(axis, variable, *_points(structure))
    return None


def _points(structure: Structure) -> list[float]:
    """Return both ends of a structure's variable, and the force at equal steps between."""
    low, high = float(structure.knots[0]), float(structure.knots[-1])
    places = np.linspace(low, high, POINTS)
    return [low, high, *map(float, np.interp(places, structure.knots, structure.force))]


def _error(model: Model, held_out: Sequence[Stretch]) -> float:
    """Return the mean logarithm of the held-out errors of v and ω."""
    return float(np.log(free_running_error(model, held_out)).mean())
