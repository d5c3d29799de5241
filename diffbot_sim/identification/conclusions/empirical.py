"""The empirical term: what is left without a name, put into the model as a table."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from diffbot_sim.identification.fitting.fit import Fit, fit_simulation
from diffbot_sim.identification.recordings.free_running import free_running_error
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.result import LIMIT, Structure, Table
from diffbot_sim.physics.effects import empirical_force, empirical_wheel_force
from diffbot_sim.physics.effects.empirical_force import POINT_NAMES, POINTS, EmpiricalForce
from diffbot_sim.physics.effects.empirical_limit import EmpiricalLimit
from diffbot_sim.physics.effects.empirical_wheel_force import EmpiricalWheelForce
from diffbot_sim.physics.model import Model

# What the table of a structure runs over, where that is not the structure's own variable.
TABLE_OF = {'constant': 'time', 'rolling': 'wheel_speed', 'turning': 'omega'}
# The term is kept when it lowers the held-out error, v and ω together, by this share.
WORTHWHILE = 0.02


def with_term(fit: Fit, structure: Structure, held_out: Sequence[Stretch]) -> Fit | None:
    """Return the fit with the structure as a table in its model, if that simulates better.

    A declared table is added to. Judged by the free-running error on held-out data; None where no
    table can look at the variable, a declared one looks at another, or the error does not fall.
    """
    table = _table_of(structure)
    table = table and _added(table, fit.space.declared)
    if table is None:
        return None
    space = replace(fit.space, declared=fit.space.declared.with_effect(table))
    trial = fit_simulation(space, fit.stretches, fit.u)
    before, after = (_error(model, held_out) for model in (fit.model, trial.model))
    return trial if after < before + np.log(1.0 - WORTHWHILE) else None


def term_in(model: Model, structure: Structure) -> Table | None:
    """Return the table of a model that stands for a structure, if there is such one."""
    table = _table_of(structure)
    alike = (
        it for it in model.effects if isinstance(it, Table) and table and _is_alike(it, table)
    )
    return next(alike, None)


def _table_of(structure: Structure) -> Table | None:
    """Return the curve of a structure as a table that the simulator runs, if there is such one."""
    if structure.variable == LIMIT:
        return EmpiricalLimit(float(structure.knots[-1]), *map(float, structure.force))
    axis, variable = structure.axis, TABLE_OF.get(structure.variable, structure.variable)
    if axis in empirical_force.AXES and variable in empirical_force.VARIABLES:
        return EmpiricalForce(axis, variable, *_points(structure))
    if axis in empirical_wheel_force.AXES and variable in empirical_wheel_force.VARIABLES:
        return EmpiricalWheelForce(axis, variable, *_points(structure))
    return None


def _added(table: Table, declared: Model) -> Table | None:
    """Return a table and what a declared one of its kind holds, in one; None if they differ."""
    there = next((it for it in declared.effects if isinstance(it, type(table))), None)
    if there is None:
        return table
    if isinstance(there, EmpiricalLimit) or isinstance(table, EmpiricalLimit):
        return None  # limits do not add up
    if not _is_alike(there, table):
        return None
    both = (there, table)
    places = np.linspace(min(it.low for it in both), max(it.high for it in both), POINTS)
    force = sum(np.interp(places, np.linspace(it.low, it.high, POINTS), it.points) for it in both)
    points = zip(POINT_NAMES, np.asarray(force).tolist(), strict=True)
    return replace(table, low=float(places[0]), high=float(places[-1]), **dict(points))


def _is_alike(one: Table, other: Table) -> bool:
    """Say whether two tables run over the same."""
    return _subject(one) == _subject(other)


def _subject(table: Table) -> tuple[str, ...]:
    if isinstance(table, EmpiricalLimit):
        return (table.name,)
    return table.name, table.axis, table.variable


def _points(structure: Structure) -> list[float]:
    """Return both ends of a structure's variable, and the force at equal steps between."""
    low, high = float(structure.knots[0]), float(structure.knots[-1])
    places = np.linspace(low, high, POINTS)
    return [low, high, *map(float, np.interp(places, structure.knots, structure.force))]


def _error(model: Model, held_out: Sequence[Stretch]) -> float:
    """Return the mean logarithm of the held-out errors of v and ω."""
    return float(np.log(free_running_error(model, held_out)).mean())
