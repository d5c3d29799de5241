"""Forces that come in bursts, harder than a floor pushes, whatever they depend on."""

from collections.abc import Sequence

import numpy as np

from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.fitting.views import View, on_wheels, views
from diffbot_sim.identification.free_forms.otherwise import force_over_time
from diffbot_sim.identification.result import Structure
from diffbot_sim.identification.statistics.norms import FAR, rms, rms_of_each
from diffbot_sim.records import Array

# What exceeds its rms so many times over stands out.
OUTSTANDING = 3.0
# What stands out as a share of the commanded forces, rms: 0.058 at most on 120 clean robots, some
# told by encoders at 10 Hz or creeping; where drives cut out or brakes let go late 0.085 or more.
MUCH = 0.075
# A form whose force is a smaller part of what stands out does not tell what that is.
SMALL_PART = 0.5
# A drive that gives less than commanded takes this share of what stands out from the command.
TAKEN = 0.9
# What lies far out of the errors is more than noise from so many times that on, rms: of three
# clean robots 0.1 at most, of one on bristles 0.3, of a load that bangs against its stops 1.1.
BEYOND_NOISE = 0.5


def bursts(fit: Fit) -> Structure | None:
    """Return the force that a noise model follows where it comes in bursts, if it does.

    Told of the run where most is followed.
    """
    seen = views(fit, fit.stretches)
    standing_out, commanded = _standing_out(seen), np.concatenate([view.force for view in seen])
    if rms(standing_out) <= MUCH * rms(commanded):
        return None
    most = max(seen, key=lambda view: rms(_followed(view)))
    right, left = standing_out.T
    axis = int(rms(right - left) > rms(right + left))
    told = force_over_time(fit, most.stretch, axis, _words(standing_out, commanded))
    # Of a model that never moves no force is felt, though its noise model follows the robot.
    return told if len(told.knots) > 0 else None


def bursts_still(as_stamped: Fit, older: Fit) -> Structure | None:
    """Return the bursts of twists as they are stamped, if older ones leave errors like them, too.

    Of what is told late a noise model follows less, so that these seem to have none. If all that
    came in bursts was their age, it is gone once they are taken as older, and errors are noise.
    """
    far_out = _beyond(FAR, older.whitened)
    return bursts(as_stamped) if rms_of_each(far_out).max() > BEYOND_NOISE else None


def is_small_part_of_bursts(told: Structure, fit: Fit) -> bool:
    """Say whether a structure is a small part of what stands out of the force that is followed."""
    at_wheel = {'v': 0.5, 'omega': 0.5 / fit.model.half_separation}.get(told.axis, 1.0)
    standing_out = _standing_out(views(fit, fit.stretches))
    return at_wheel * told.strength < SMALL_PART * rms(standing_out)


def _standing_out(seen: Sequence[View]) -> Array:
    """Return what is followed where it stands out, 0 elsewhere, shape (k, 2)."""
    force = np.concatenate([_followed(view) for view in seen])
    return _beyond(OUTSTANDING * rms(force), force)


def _beyond(limit: float, values: Array) -> Array:
    """Return values that are larger than a limit, 0 in place of all others."""
    return np.where(np.abs(values) > limit, values, 0.0)


def _followed(view: View) -> Array:
    """Return the force on each wheel [N] that the noise model follows, shape (k, 2)."""
    return on_wheels(view.prediction.disturbance, view.fit.model.half_separation)


def _words(standing_out: Array, commanded: Array) -> str:
    taken = standing_out[standing_out * commanded < 0.0]
    is_taken = np.sum(taken**2) > TAKEN * np.sum(standing_out**2)
    like = ', as if the drives gave less than commanded for moments,' if is_taken else ''
    return f'that comes in bursts{like} and that no effect of the library accounts for'
