"""Calibration: the declared model's free parameters by simulation error, from several starts."""

from itertools import product

import numpy as np

from diffbot_sim.identification.fitting.coordinates import Space
from diffbot_sim.identification.fitting.fit import Fit, fit_simulation, innovations
from diffbot_sim.identification.fitting.predictor import NO_GAIN
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.statistics.minimisation import scale
from diffbot_sim.identification.statistics.robust import huber
from diffbot_sim.records import Array

# Factors by which starting points differ from the declared model: inertial and friction part.
MASS_FACTORS, FRICTION_FACTORS = (0.6, 1.0, 1.6), (0.5, 1.0, 2.0)
# How many of the starting points are followed, and for how long, before one is chosen.
FOLLOWED, SHORT = 3, 8


def calibrate(space: Space, stretches: tuple[Stretch, ...]) -> Fit:
    """Fit by simulation error; the error surface has local minima, hence the several starts."""
    starts = _starts(space)
    errors = [simulation_errors(space, stretches, start) for start in starts]
    usual = np.maximum(np.median([np.mean(np.abs(e), axis=0) for e in errors], axis=0), 1e-12)
    order = np.argsort([float(huber(e / usual).sum()) for e in errors])[:FOLLOWED]
    followed = [fit_simulation(space, stretches, starts[index], SHORT) for index in order]
    return fit_simulation(space, stretches, min(followed, key=simulation_error).u)


def simulation_errors(space: Space, stretches: tuple[Stretch, ...], point: Array) -> Array:
    """Return the errors of a simulation in speed [m/s] and turn rate [rad/s], shape (n, 2)."""
    return innovations(stretches, space.model(point), NO_GAIN)


def simulation_error(fit: Fit) -> float:
    """Return the logarithm of the generalised variance of a fit's errors."""
    return float(np.log(fit.sigma).sum())


def simulation_error_at(space: Space, stretches: tuple[Stretch, ...], point: Array) -> float:
    """Return that of a point, as it is."""
    return float(np.log(scale(simulation_errors(space, stretches, point))).sum())


def _starts(space: Space) -> list[Array]:
    """Return points around the declared model."""
    starts = []
    for mass, friction in product(MASS_FACTORS, FRICTION_FACTORS):
        start = space.prior()
        for index, coordinate in enumerate(space.nominal):
            if coordinate.name in ('mass', 'inertia'):
                start[index] += np.log(mass)
            elif coordinate.name != 'stribeck':
                start[index] *= friction
        starts.append(start)
    return starts
