"""Held-out data in which a robot moves otherwise than in those that were fitted.

It may have come to another floor, or taken up a load, after the fit ended. No law of what it did
until then tells that, and none can be found by what it did: it can only be noticed.
"""

from collections.abc import Sequence
from dataclasses import replace
from math import nan

import numpy as np

from diffbot_sim.identification.fitting.fit import Fit, whitened
from diffbot_sim.identification.fitting.response import responses
from diffbot_sim.identification.fitting.views import views
from diffbot_sim.identification.free_forms.moments import over_time
from diffbot_sim.identification.free_forms.structure import FORCES
from diffbot_sim.identification.free_forms.variable import BODY
from diffbot_sim.identification.recordings.start import restarted
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.result import Structure
from diffbot_sim.identification.statistics.norms import rms
from diffbot_sim.identification.statistics.robust import huber
from diffbot_sim.records import Array

# Parts of what is held out of a run; fitted parts as long as these are held against them.
PARTS = 5
# Errors that weigh so many times what they do in the worst fitted part are of something else.
MUCH = 2.0
# Gains that correct the speed all but fully: then an error tells the force since the last sample.
FOLLOWING = np.array([0.9, 0.0, 0.0, 0.9, 0.0, 0.0])


def moves_otherwise(fit: Fit, held_out: Sequence[Stretch]) -> Structure | None:
    """Return the force that a fit lacks in held-out data alone, if there is one.

    Told of the run that it acts in most.
    """
    begun = restarted(fit.model, held_out)
    excess = np.array([excess_of(fit, stretch) for stretch in begun])
    index, axis = map(int, np.unravel_index(excess.argmax(), excess.shape))
    if excess[index, axis] <= MUCH:
        return None
    most = begun[index]
    whose = f' of {most.run.name}' if len(begun) > 1 else ''
    words = (
        f'that acts in the held-out data{whose} alone, not where the model was fitted, and that '
        'no effect of the library accounts for'
    )
    return force_over_time(fit, most, axis, words)


def excess_of(fit: Fit, stretch: Stretch) -> Array:
    """Return how many times more errors weigh than in the worst fitted part, for v and ω."""
    there = huber(whitened((stretch,), fit.model, fit.gains, fit.sigma))
    here = huber(fit.whitened)
    usual = _weights(here, max(1, len(here) * PARTS // len(there)))
    # Errors of their scale weigh 1: where they are less, none is of something else.
    most = np.maximum(usual.max(axis=0), 1.0)
    return np.asarray(np.median(_weights(there, PARTS), axis=0) / most)


def _weights(squares: Array, parts: int) -> Array:
    """Return what errors weigh in the mean of each part, shape (parts, 2)."""
    return np.array([part.mean(axis=0) for part in np.array_split(squares, parts)])


def force_over_time(fit: Fit, stretch: Stretch, axis: int, words: str) -> Structure:
    """Return the force, or torque, that a fit lacks in a stretch, over time.

    words: what is said of it, after its size.
    """
    following = replace(fit, stretches=(stretch,), gains=FOLLOWING)
    (view,), (response,) = views(following, following.stretches), responses(following)
    knots, force, error = over_time(view, response, axis)
    strength = rms(force)
    kind, unit = FORCES[BODY[axis]]
    return Structure(
        description=f'a {kind} of {strength:.3g} {unit} rms {words}',
        axis=BODY[axis],
        variable='time_of_push',
        over='time [s]',
        strength=strength,
        p_value=nan,
        knots=knots,
        force=force,
        force_error=error,
    )
