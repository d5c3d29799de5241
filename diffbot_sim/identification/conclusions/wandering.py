"""What estimates owe to a way that is only known as the noise of the twists adds up.

Ripples hang on the angles of the wheels, slopes on the heading. Where both are sums of twists
their errors wander. Blocks of a run hardly tell of that, for one drifts on from the other.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from diffbot_sim.identification.fitting.fit import Fit, whitened
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.recordings.way import pose_knows_more
from diffbot_sim.identification.statistics.norms import white_noise
from diffbot_sim.records import Array

# So many terms of Karhunen and Loève hold 97 % of the variance of a random walk.
TERMS = 8


def wandering(fit: Fit, slopes: Array) -> Array:
    """Return the covariance of parameters that the errors of the measured way bring about.

    slopes: derivatives of the whitened errors by the parameters, shape (n, 2, p); the covariance,
    shape (p, p), is of the least-squares answer to them, to first order.
    """
    answer = np.linalg.pinv(slopes.reshape(-1, slopes.shape[-1]), rcond=1e-8)
    ends = np.cumsum([stretch.used.sum() for stretch in fit.stretches])[:-1]
    shares = np.split(answer.reshape(len(answer), -1, 2), ends, axis=1)
    parts = zip(fit.stretches, shares, np.split(fit.whitened, ends), strict=True)
    moved = [
        np.tensordot(share, change, 2)
        for stretch, share, errors in parts
        for change in _changes(fit, stretch, errors)
    ]
    return np.asarray(np.transpose(moved) @ moved) if moved else np.zeros(2 * answer.shape[:1])


def _changes(fit: Fit, stretch: Stretch, errors: Array) -> Iterator[Array]:
    """Yield what each independent wandering, one deviation, adds to a stretch's errors, (n, 2)."""
    if pose_knows_more(stretch.run.odometry):
        return
    for error in _walks(stretch, errors * fit.sigma):
        astray = _led_astray(stretch, error)
        yield whitened((astray,), fit.model, fit.gains, fit.sigma) - errors


def _walks(stretch: Stretch, missed: Array) -> Iterator[Array]:
    """Yield independent errors of way [m] and turn [rad], one deviation of each, (k, 2)."""
    deviation = np.sqrt(_growth(stretch, missed))
    last = float(stretch.time[-1])
    for term in range(TERMS):
        pace = (term + 0.5) * np.pi / last
        shape = np.sqrt(2.0 / last) / pace * np.sin(pace * stretch.time)
        for axis in np.eye(2):
            yield np.outer(shape, axis * deviation)


def _growth(stretch: Stretch, missed: Array) -> Array:
    """Return by how much the variance of way and turn grows in a second, shape (2,).

    By the white noise of the twists, or what of errors does not cancel from sample to sample, if
    that is less: encoders make up for what they rounded off, and floors err more than a sensor.
    """
    white = white_noise(stretch.run.odometry.twist) ** 2
    lasting = np.mean(missed**2, axis=0) + 2.0 * np.mean(missed[1:] * missed[:-1], axis=0)
    return np.asarray(np.clip(lasting, 0.0, white) * stretch.interval)


def _led_astray(stretch: Stretch, error: Array) -> Stretch:
    """Return a stretch whose way and heading were measured with this error, shape (k, 2)."""
    return replace(stretch, way=stretch.way + error, heading=stretch.heading + error[:, 1])
