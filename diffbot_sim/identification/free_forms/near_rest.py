"""Friction near rest: of whatever form it is, it is allowed for before something is unexplained.

The declared friction holds a wheel at rest until it breaks away, and falls exponentially from
there. Contacts creep, or bend like springs, and laws of Stribeck friction differ: at a few
centimetres a second all that is known of friction is an approximation. It is in every force that
acts against the motion, whatever else that depends on, and none of them is told because of it. Nor
is what moves a wheel that the declared friction still holds: a share of the force that drives it;
nor how softly tyres begin to scrub as the robot turns. What holds harder against the drive than
friction does, as a brake, is told.
"""

from collections.abc import Sequence
from functools import partial

import numpy as np

from diffbot_sim.identification.fitting.fit import Fit, fit_prediction
from diffbot_sim.identification.fitting.views import commanded, on_wheels
from diffbot_sim.identification.free_forms.bases import again, bases
from diffbot_sim.identification.free_forms.dependence import (
    best_against_the_model,
    explained_by,
    realised,
    worth_of,
)
from diffbot_sim.identification.free_forms.variables import ALLOWED_FOR, ALLOWED_FOR_TURNING
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.selection.screening import Screen
from diffbot_sim.identification.statistics.parallel import side_by_side
from diffbot_sim.physics.effects.yaw_friction import YawFriction

Stretches = tuple[Stretch, ...]

# What holds a wheel harder than so many times its static friction is no friction of another form:
# on clean robots on wheels that creep or bend it was 0.8 times that at most, where a brake let go
# late 3 times.
MOST = 1.5
# How often what is allowed for is looked at again: which way a wheel creeps follows from it.
ROUNDS = 3


def eased(fit: Fit, held_out: Sequence[Stretch]) -> tuple[Fit, Stretches]:
    """Return a fit, and held-out data, with a push in place of friction near rest, if it pays."""
    held = tuple(held_out)
    for _ in range(ROUNDS):
        better = _eased_once(fit, held)
        if better is None:
            break
        fit, held = better
    return fit, held


def _eased_once(fit: Fit, held_out: Stretches) -> tuple[Fit, Stretches] | None:
    screen = Screen(fit)
    tried = (explained_by(screen, b) for b in bases(fit, fit.stretches, _allowed_for(fit)))
    friction = best_against_the_model(fit, side_by_side(partial(realised, fit), tried))
    if worth_of(friction, fit) <= 0.0:
        return None

    def pushed(stretches: Stretches) -> Stretches:
        return again(friction.basis, fit, stretches).pushed(stretches, friction.amounts)

    u, gains = np.split(friction.adapted(fit), [len(fit.u)])
    better = fit_prediction(fit.space, pushed(fit.stretches), u, gains)
    return None if _hardest_hold(better) > MOST * _holding(better) else (better, pushed(held_out))


def _hardest_hold(fit: Fit) -> float:
    """Return the largest force [N] on a wheel that is allowed for against what drives it."""
    pushes = np.concatenate([stretch.pushes for stretch in fit.stretches])
    pushed = on_wheels(pushes, fit.model.half_separation)
    driven = np.concatenate([commanded(stretch) for stretch in fit.stretches])
    return float(np.max(-pushed * np.sign(driven)))


def _holding(fit: Fit) -> float:
    """Return the force [N] at a wheel up to which friction holds the robot at rest.

    As it was declared, if more: what is allowed for may have taken the place of it.
    """
    static = max(model.friction.law().static for model in (fit.model, fit.space.declared))
    scrub = sum(e.dry for e in fit.model.effects if isinstance(e, YawFriction))
    return float(static + 0.5 * scrub / fit.model.half_separation)


def _allowed_for(fit: Fit) -> tuple[str, ...]:
    """Return what is allowed for; of turning nothing, unless something rubs against it."""
    rubs = any(effect.name == YawFriction.name for effect in fit.model.effects)
    return (*ALLOWED_FOR, ALLOWED_FOR_TURNING) if rubs else ALLOWED_FOR
