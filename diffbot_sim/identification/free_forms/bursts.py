"""Forces that come in bursts, harder than a floor pushes, whatever they depend on."""

import numpy as np

from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.fitting.predictor import SPEED, at_end
from diffbot_sim.identification.fitting.views import View, on_wheels, views
from diffbot_sim.identification.free_forms.otherwise import force_over_time
from diffbot_sim.identification.result import Structure
from diffbot_sim.identification.statistics.norms import FAR, rms
from diffbot_sim.records import Array

# What exceeds its rms so many times over stands out.
OUTSTANDING = 3.0
# What stands out as a share of the commanded forces, rms: of what is followed 0.058 at most on 120
# clean robots, some told by encoders at 10 Hz or creeping; where drives cut out or brakes let go
# late 0.085 or more. What is missed is nothing on most clean robots, while no twist is a mean.
MUCH = 0.075
# A form whose force is a smaller part of what stands out does not tell what that is.
SMALL_PART = 0.5
# A drive that gives less than commanded takes this share of what stands out from the command.
TAKEN = 0.9
# An error is one of the motion if the next leaves so much of it that was not corrected: where the
# odometry was at fault for a moment, the next takes back what was.
LASTING = 0.5


def bursts(fit: Fit) -> Structure | None:
    """Return the force that comes in bursts, followed by the noise model or missed, if one does.

    Told of the run where most of it is.
    """
    seen = views(fit, fit.stretches)
    forces = [_followed(view) + _missed(view) for view in seen]
    standing_out = _standing_out(np.concatenate(forces))
    commanded = np.concatenate([view.force for view in seen])
    if rms(standing_out) <= MUCH * rms(commanded):
        return None
    most = int(np.argmax(list(map(rms, forces))))
    right, left = standing_out.T
    axis = int(rms(right - left) > rms(right + left))
    told = force_over_time(fit, seen[most].stretch, axis, _words(standing_out, commanded))
    # Of a model that never moves no force is felt, though its noise model follows the robot.
    return told if len(told.knots) > 0 else None


def is_small_part_of_bursts(told: Structure, fit: Fit) -> bool:
    """Say whether a structure is a small part of what stands out of the force that is followed."""
    at_wheel = {'v': 0.5, 'omega': 0.5 / fit.model.half_separation}.get(told.axis, 1.0)
    followed = np.concatenate([_followed(view) for view in views(fit, fit.stretches)])
    return at_wheel * told.strength < SMALL_PART * rms(_standing_out(followed))


def _standing_out(force: Array) -> Array:
    """Return a force where it stands out, 0 elsewhere, shape (k, 2)."""
    return _beyond(OUTSTANDING * rms(force), force)


def _beyond(limit: float | Array, values: Array) -> Array:
    """Return values that are larger than a limit, 0 in place of all others."""
    return np.where(np.abs(values) > limit, values, 0.0)


def _followed(view: View) -> Array:
    """Return the force on each wheel [N] that the noise model follows, shape (k, 2)."""
    return on_wheels(view.prediction.disturbance, view.fit.model.half_separation)


def _missed(view: View) -> Array:
    """Return the force on each wheel [N] that errors far out tell of, if they last, (k, 2)."""
    fit, stretch, errors = view.fit, view.stretch, view.innovation
    left = fit.gains[SPEED] * at_end(stretch) * errors
    left[:-1] += errors[1:]
    lasting = np.where(left * errors > LASTING * errors**2, errors, 0.0)
    push = _beyond(FAR * fit.sigma, lasting) * fit.model.pack()[:2] / stretch.intervals[:, None]
    return on_wheels(push, fit.model.half_separation)


def _words(standing_out: Array, commanded: Array) -> str:
    taken = standing_out[standing_out * commanded < 0.0]
    is_taken = np.sum(taken**2) > TAKEN * np.sum(standing_out**2)
    like = ', as if the drives gave less than commanded for moments,' if is_taken else ''
    return f'that comes in bursts{like} and that no effect of the library accounts for'
