"""What is said of a spot of the floor must hold whenever the robot is there again.

A push at one moment acts at a place, too, and the parts of a small spot are parts of that moment.
"""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.free_forms.bases import Basis
from diffbot_sim.identification.free_forms.dependence import Dependence, beside
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.statistics.robust import huber
from diffbot_sim.records import Array

# So long after a visit [s] it is still felt.
AFTER = 1.0
# A rise of the deviance that chance alone hardly makes: that of two standard deviations.
DENIED = 4.0


def is_denied_on_return(fit: Fit, spot: Dependence) -> bool:
    """Say whether a realised spot errs on its visits, but for the one that it explains best."""
    gain = (huber(fit.whitened) - huber(beside(fit, spot))).sum(axis=1)
    gains = [float(gain[rows].sum()) for rows in _visits(spot.basis, fit.stretches)]
    return sum(gains) - max(gains, default=0.0) < -DENIED


def _visits(basis: Basis, stretches: tuple[Stretch, ...]) -> Iterator[NDArray[np.intp]]:
    """Return the used samples of each visit, and soon after, as rows of all stretches together."""
    begin = 0
    for values, stretch in zip(basis.values, stretches, strict=True):
        felt = _felt(np.any(values != 0.0, axis=(1, 2)), stretch.time)[stretch.used]
        edges = np.flatnonzero(np.diff(felt, prepend=False, append=False))
        for first, end in edges.reshape(-1, 2):
            yield begin + np.arange(first, end)
        begin += int(np.count_nonzero(stretch.used))


def _felt(there: NDArray[np.bool_], time: Array) -> NDArray[np.bool_]:
    """Say of each sample whether the robot is at the spot, or was a short while ago."""
    last = np.maximum.accumulate(np.where(there, time, -np.inf))
    return np.asarray(time - last <= AFTER)
