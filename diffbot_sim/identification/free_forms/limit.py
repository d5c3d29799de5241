"""Limits of another law: a named limit of the wheels' force is held against one without a law."""

from collections.abc import Sequence

import numpy as np

from diffbot_sim.identification.fitting.coordinates import Space, point_of
from diffbot_sim.identification.fitting.fit import Fit, fit_prediction
from diffbot_sim.identification.fitting.views import View, views
from diffbot_sim.identification.recordings.stretches import largest_command
from diffbot_sim.identification.result import LIMIT, Structure
from diffbot_sim.identification.selection.evidence import delta_bic, wald
from diffbot_sim.identification.selection.rivals import is_told_apart
from diffbot_sim.identification.statistics.blocks import sandwich
from diffbot_sim.identification.statistics.norms import rms
from diffbot_sim.physics.effects import Effect
from diffbot_sim.physics.effects.actuator_saturation import ActuatorSaturation
from diffbot_sim.physics.effects.empirical_limit import (
    PLACES,
    UNLIMITED,
    EmpiricalLimit,
    limited_widely,
)
from diffbot_sim.physics.effects.power_limit import PowerLimit
from diffbot_sim.physics.effects.voltage_limit import VoltageLimit
from diffbot_sim.physics.stages import Motion, Traction
from diffbot_sim.records import Array


class WideLimit(EmpiricalLimit):
    """The same with wider corners: what a table is held for must not be the law's own corner."""

    kernel = limited_widely


# Limits that have names, each with the table of the same corners.
TABLES: dict[type[Effect], type[EmpiricalLimit]] = {
    ActuatorSaturation: EmpiricalLimit,
    PowerLimit: WideLimit,
    VoltageLimit: EmpiricalLimit,
}
# A limit of so many times the largest command is none, and needs not be told.
OUT_OF_REACH = 2.0


def of_another_law(kind: type[Effect], rest: Fit, final: Fit) -> Structure | None:
    """Return the limit without a law that outdoes a named one; None where the law holds.

    rest: the fit that lacks the name, final: the one that has it. A table needs more numbers than
    any law: it is believed where it lowers the BIC all the same, beyond doubt.
    """
    free = _without_law(kind, final)
    return _described(free, delta_bic(rest, free)) if is_told_apart(final, free) else None


def _without_law(kind: type[Effect], named: Fit) -> Fit:
    """Fit a table in the place of a law, from where that lies."""
    (law,) = (effect for effect in named.model.effects if isinstance(effect, kind))
    seen = views(named, named.stretches)
    speed = max(float(np.abs(view.wheel_speed).max()) for view in seen)
    limits = [_limit_of(law, share * speed) for share in PLACES]
    others = tuple(other for other in named.space.kinds if other is not kind)
    start = np.delete(named.u, named.space.places(kind.name))
    return fit_prediction(
        Space(named.space.declared, (*others, TABLES[kind])),
        named.stretches,
        np.append(start, point_of(EmpiricalLimit, (speed, *limits))),
        named.gains,
    )


def _limit_of(law: Effect, speed: float) -> float:
    """Return the largest force [N] that a law allows a wheel that turns with it at a speed."""
    at = Motion(0.0, 0.0, 0.0, 0.0, 0.0, speed, 0.0, 0.0, 0.0, speed, speed)
    asked = Traction(UNLIMITED, UNLIMITED)
    return float(type(law).kernel(at, asked, *law.values).right)


def _described(free: Fit, worth: float) -> Structure:
    """Put a limit without a law into words and a curve, as far as commands reach."""
    *_, (speed, *limits) = (e.values for e in free.model.effects if isinstance(e, EmpiricalLimit))
    reach = OUT_OF_REACH * largest_command(free.stretches)
    knots, force = speed * np.array(PLACES), np.minimum(limits, reach)
    end, *points = free.space.places(EmpiricalLimit.name)
    seen = views(free, free.stretches)
    taken = np.concatenate([_taken(view, knots, force) for view in seen])
    lowest = int(np.where(knots > 0.0, force, np.inf).argmin())
    return Structure(
        description=(
            f'a limit of the force on each wheel (of {force[lowest]:.3g} N at '
            f'{knots[lowest]:.3g} m/s) that changes with its speed as no limit of the library does'
        ),
        axis='wheels',
        variable=LIMIT,
        over='speed of a wheel, the way that the force drives it [m/s]',
        strength=rms(taken),
        p_value=wald(free, points, [end]),
        knots=knots,
        force=force,
        force_error=_errors(free, points, force),
        worth=worth,
    )


def _taken(view: View, knots: Array, force: Array) -> Array:
    """Return by how much a limit is below what was commanded [N], shape (k, 2)."""
    allowed = 1.0 / np.interp(np.sign(view.force) * view.wheel_speed, knots, 1.0 / force)
    return np.asarray(np.maximum(np.abs(view.force) - allowed, 0.0))


def _errors(free: Fit, points: Sequence[int], force: Array) -> Array:
    """Return the standard errors of the limits [N], shape (n,)."""
    spread = sandwich(free.slopes, free.whitened.ravel(), free.prior_information)
    scale = np.array([spec.scale for spec in EmpiricalLimit.specs()[1:]])
    # What is hardly known at all may have a variance below zero, by rounding.
    known = np.maximum(np.diag(spread)[points], 0.0)
    return np.asarray(force**2 * np.sqrt(known) / scale)
