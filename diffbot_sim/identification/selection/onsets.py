"""Effects that set in at a moment, to first order: it changes the steps that begin after it.

Each step is changed once, whatever the moments that are tried: a look at a moment costs no more
than a recursion along the run.
"""

from threading import Lock

import numpy as np

from diffbot_sim.identification.fitting.coordinates import Space
from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.fitting.response import Response
from diffbot_sim.identification.fitting.steps import Steps
from diffbot_sim.identification.statistics.minimisation import slope
from diffbot_sim.records import Array

# Steps as they are differ by nothing.
NONE = np.zeros(4)


class Onsets:
    """What effects do to the errors of a fit from any moment on.

    amount: a small one, in coordinates of order one.
    """

    def __init__(self, fit: Fit, responses: tuple[Response, ...], amount: float) -> None:
        self._fit, self._responses, self._amount = fit, responses, amount
        self._steps = [Steps(fit.model, stretch, fit.gains) for stretch in fit.stretches]
        self._known, self._knowing = dict[tuple[str, bytes], list[Array]](), Lock()

    def slopes(self, space: Space, onset: int, point: Array, turned: list[int]) -> Array:
        """Return the derivative of the whitened errors by some amounts, shape (n, 2, q).

        onset: where in the point the moment stands; turned: where the amounts stand.
        """
        from_start = point.copy()
        from_start[onset] = 0.0
        moment = space.coordinates[onset].value(float(point[onset]))
        changes = [self._changes(space, from_start, index) for index in turned]
        errors = []
        for stretch, response, *each in zip(
            self._fit.stretches, self._responses, *changes, strict=True
        ):
            later = np.append(False, stretch.time[:-1] >= moment)
            errors.append(response.carried(np.stack(each, axis=-1) * later[:, None, None]))
        return self._fit.whiten(errors)

    def _changes(self, space: Space, point: Array, index: int) -> list[Array]:
        """Return what a unit of an amount changes in each step of each stretch, (k, 4)."""
        key = (space.coordinates[index].name, point.tobytes())
        with self._knowing:  # several moments are looked at side by side
            if key not in self._known:
                changes = [self._slope(steps, space, point, index) for steps in self._steps]
                self._known[key] = changes
            return self._known[key]

    def _slope(self, steps: Steps, space: Space, point: Array, index: int) -> Array:
        """Return it for one stretch."""

        def changed(at: Array) -> Array:
            return steps.changed(space.model(at))

        lowest = space.bounds()[0][index]
        return slope(changed, point, NONE, index, self._amount, lowest)
