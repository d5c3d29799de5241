"""What is found is there to be simulated: which fit simulates best, and which names spoil it."""

from dataclasses import replace

import numpy as np

from diffbot_sim.identification.doubt import Seen, doubt
from diffbot_sim.identification.fitting.calibration import (
    simulation_error,
    simulation_error_at,
    simulation_errors,
)
from diffbot_sim.identification.fitting.coordinates import Space
from diffbot_sim.identification.fitting.fit import Fit, fit_simulation
from diffbot_sim.identification.found import Found
from diffbot_sim.identification.recordings.free_running import (
    NOTHING,
    free_running_error,
    run_free,
)
from diffbot_sim.identification.recordings.noiseless import is_noiseless
from diffbot_sim.identification.recordings.start import restarted
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.selection.trials import WORSENING
from diffbot_sim.identification.statistics.norms import noise_floor, rms_of_each
from diffbot_sim.records import Array

# Prediction fits are kept for simulation unless a fit by simulation error does this much better:
# pushes of a rough floor last, so the latter fits some of them, too.
SIMULATION_MARGIN = 0.5
# A name that raises the held-out error of v or of ω to more than this share of what it is without
# it simulates worse, if it does so in step and out of step with the robot.
WORSE = 1.1


def for_simulation(found: Found) -> Fit:
    """Choose the parameters that will be simulated.

    One-step prediction gives the sharper estimate when the structure is complete. Where it is
    not, the fit by simulation error is the one that simulates best, and is taken. Friction near
    rest that was allowed for is no part of what is simulated: declared friction makes up for it.
    """
    final, plain = found.selection.final, found.recalibrated.stretches
    if not final.space.kinds:
        return found.recalibrated
    if found.unexplained:
        return _simulating(final.space, plain, final.u) or final
    if found.near_rest <= 0.0:
        return final
    nominal = Space(final.model, ())
    return _simulating(nominal, plain, nominal.prior()) or final


def _simulating(space: Space, stretches: tuple[Stretch, ...], predicted: Array) -> Fit | None:
    """Return a fit by simulation error, if that is much less than at a predicted point."""
    simulated = fit_simulation(space, stretches, predicted)
    most = simulation_error_at(space, stretches, predicted) - SIMULATION_MARGIN
    return simulated if simulation_error(simulated) < most else None


def is_integrators(found: Found, noise: Array) -> bool:
    """Say whether another integrator than ours may have left, or hidden, what was found.

    So it may where recordings lack an odometry's noise (2,) and not all is explained, allowing
    for nothing, and simulated to that.
    """
    told = [stretch.twist for stretch in found.held_out]
    free = [run_free(found.selection.final.model, stretch).twist for stretch in found.held_out]
    if not is_noiseless(noise_floor(told, free), noise):
        return False
    if found.unexplained is not None or found.near_rest > 0.0:
        return True
    return bool(np.any(free_running_error(for_simulation(found).model, found.held_out) > noise))


def without_worsening(found: Found) -> Found:
    """Withdraw names that, beside what is unexplained or allowed for, make the simulation worse.

    What acts may look like an effect where it was fitted, and like its contrary elsewhere. Then
    nothing is allowed for any more.
    """
    if found.unexplained is None and found.near_rest <= 0.0:
        return found
    final = _held_out_errors(found, found.selection.final)
    ratios = {
        name: float(np.max(final / _held_out_errors(found, rest), axis=1).min())
        for name, rest in found.selection.without.items()
    }
    worst = max(ratios, key=ratios.__getitem__, default='')
    if not worst or ratios[worst] <= WORSE:
        return found
    rest = found.selection.withdrawn(worst, found.held_out, WORSENING)
    doubted = doubt(Seen(rest, found.held_out))
    unexplained = doubted.unexplained or found.unexplained
    found = replace(found, selection=doubted.selection, unexplained=unexplained, near_rest=0.0)
    return without_worsening(found)


def _held_out_errors(found: Found, fit: Fit) -> Array:
    """Return the simulation errors of v [m/s] and ω [rad/s] of a structure, shape (2, 2).

    First those of a free run, then those with heading and wheel angles as measured: out of step
    by half a cycle a true ripple is worse than none.
    """
    simulated = _simulating(fit.space, found.recalibrated.stretches, fit.u) or fit
    begun = restarted(simulated.model, found.held_out)
    in_step = simulation_errors(simulated.space, begun, simulated.u)
    free = free_running_error(simulated.model, found.held_out)
    return np.array([free, np.maximum(rms_of_each(in_step), NOTHING)])
