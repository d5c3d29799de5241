"""Stretches as a fit sees them: what effects and free forms may depend on, at every sample."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from diffbot_sim.identification.fitting.fit import Fit, predictions
from diffbot_sim.identification.fitting.predictor import NO_GAIN, Prediction, predict
from diffbot_sim.identification.recordings.acting import added_up
from diffbot_sim.identification.recordings.stretches import Stretch, largest_command
from diffbot_sim.records import Array

# A force [N] that is as good as none.
NO_FORCE = 1e-9


@dataclass(frozen=True)
class View:
    """A stretch as a fit sees it."""

    fit: Fit
    stretch: Stretch
    prediction: Prediction

    @property
    def v(self) -> Array:
        """Speed [m/s], shape (k,)."""
        return self.prediction.twist[:, 0]

    @property
    def omega(self) -> Array:
        """Yaw rate [rad/s], shape (k,)."""
        return self.prediction.twist[:, 1]

    @cached_property
    def wheel_speed(self) -> Array:
        """Speeds of the wheels [m/s], shape (k, 2)."""
        return self.prediction.twist @ self.mix

    @cached_property
    def wheel_angle(self) -> Array:
        """Angles of the wheels [rad], shape (k, 2)."""
        radius = self.fit.model.robot.wheel_radius
        return np.asarray(self.stretch.way @ self.mix / radius)

    @cached_property
    def simulated(self) -> Array:
        """Free-running simulation of the twist: no noise drives it, shape (k, 2)."""
        return predict(self.fit.model, self.stretch, NO_GAIN).twist

    @property
    def innovation(self) -> Array:
        """Errors of the prediction in v and ω, 0 where they do not count, shape (k, 2)."""
        return self.prediction.innovation * self.stretch.used[:, None]

    @property
    def largest_force(self) -> float:
        """The largest force commanded where the fit was made [N], of held-out data the same."""
        return max(largest_command(self.fit.stretches), NO_FORCE)

    @property
    def mix(self) -> Array:
        """What takes (v, ω) to the speeds of the wheels, shape (2, 2)."""
        b = self.fit.model.half_separation
        return np.array([[1.0, 1.0], [b, -b]])

    @cached_property
    def force(self) -> Array:
        """Commanded forces [N], shape (k, 2)."""
        return commanded(self.stretch)

    def past_force(self, first: float, last: float) -> Array:
        """Return commanded forces averaged from `last` to `first` seconds ago, shape (k, 2)."""
        commands, time = self.stretch.run.commands, self.stretch.time
        until = (added_up(commands.time, commands.force, time - lag) for lag in (first, last))
        return np.asarray(np.subtract(*until) / (last - first))


def views(fit: Fit, stretches: Sequence[Stretch]) -> list[View]:
    """Return stretches as a fit sees them."""
    found = predictions(fit, stretches)
    return [View(fit, s, p) for s, p in zip(stretches, found, strict=True)]


def commanded(stretch: Stretch) -> Array:
    """Return the commanded forces [N] at every sample of a stretch, shape (k, 2)."""
    return stretch.run.commands.held_at(stretch.time)


def on_wheels(push: Array, half_separation: float) -> Array:
    """Return what force [N] and torque [N·m] on the body, (k, 2), are on both wheels, (k, 2)."""
    force, turning = push[:, 0], push[:, 1] / half_separation
    return 0.5 * np.column_stack([force + turning, force - turning])
