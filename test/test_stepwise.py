"""The search for a structure: what enters must be needed in the end."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from fits import SMOOTH, fitted
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.recordings.stretches import Stretch
from diffbot_sim.identification.selection.candidates import approach, complete
from diffbot_sim.identification.selection.evidence import compare, likelihood_ratio, rise_without
from diffbot_sim.identification.selection.screening import Screen
from diffbot_sim.identification.selection.stepwise import (
    Selection,
    Tried,
    forward,
    select,
    tried_on,
)
from diffbot_sim.identification.selection.trials import (
    CHANCE,
    ESSENTIAL_SHARE,
    NEEDLESS,
    OUTDONE,
    SUPPORTED,
    try_all,
)
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects import Effect
from diffbot_sim.physics.effects.actuator_gain import ActuatorGain
from diffbot_sim.physics.effects.actuator_saturation import ActuatorSaturation
from diffbot_sim.physics.effects.friction_drift import FrictionDrift
from diffbot_sim.physics.effects.quadratic_drag import QuadraticDrag
from diffbot_sim.physics.effects.voltage_limit import VoltageLimit
from diffbot_sim.physics.effects.wheel_friction_asymmetry import WheelFrictionAsymmetry

Held = tuple[Stretch, ...]


def entered(fit: Fit, kinds: list[type[Effect]], held_out: Held) -> Sequence[Tried]:
    """Return the structures of the forward search, from a fit of the declared model."""
    first = tried_on(fit, kinds, held_out, lambda text: None)
    return forward([first], kinds, held_out, lambda text: None)


@pytest.mark.parametrize(('coefficient', 'names'), [(0.05, []), (0.1, ['quadratic_drag'])])
def test_name_is_told_only_where_the_data_can_tell_it_from_none(
    coefficient: float, names: list[str]
) -> None:
    dragging, noisy = Model(effects=(QuadraticDrag(coefficient),)), Surroundings(0.015, 0.03)
    fit, held_out = fitted(rehearse(dragging, random_forces(3, 60.0, -9.0, 11.0), noisy, 3))
    path = entered(fit, [QuadraticDrag], held_out)
    assert path[0].trials[0].accepted
    found = select(path, [QuadraticDrag], held_out, lambda text: None)
    assert list(found.support) == names
    assert [told.outcome for told in found.trials] == [SUPPORTED if names else NEEDLESS]


@pytest.mark.parametrize(
    ('acts', 'is_of_voltage'),
    [(ActuatorSaturation(7.0), False), (VoltageLimit(8.0, 3.0), True)],
)
def test_limit_is_one_of_voltage_where_it_does_much_by_falling_with_speed(
    acts: Effect, is_of_voltage: bool
) -> None:
    limited = Model(effects=(acts,))
    without, _ = fitted(rehearse(limited, random_forces(3, 60.0, -9.0, 11.0), SMOOTH, 3))
    screen = Screen(without)
    fit = complete(approach(screen, VoltageLimit))
    _, falls, _ = fit.space.places('voltage_limit')
    much = ESSENTIAL_SHARE * likelihood_ratio(without, fit)
    assert (rise_without(fit, [falls]) > much) == is_of_voltage


def test_limit_that_acts_for_moments_enters_where_other_data_confirm_it() -> None:
    drive = random_forces(3, 60.0, -9.0, 11.0)
    strong = np.any([abs(drive.time - at) < 1.0 for at in (11.0, 51.0)], axis=0)
    drive = replace(drive, force=np.where(strong[:, None], 1.0, 0.5) * drive.force)
    limited = Model(effects=(VoltageLimit(9.0, 3.0),))
    fit, held_out = fitted(rehearse(limited, drive, SMOOTH, 3))
    (trial,) = try_all(Screen(fit), [VoltageLimit], held_out, lambda text: None)
    assert trial.accepted


@pytest.fixture(scope='module')
def hiding() -> tuple[Tried, Selection, Held]:
    """Return trials and search where each of two effects undoes what the other does."""
    acting = (ActuatorGain(0.008), WheelFrictionAsymmetry(0.012, 0.012))
    drive, noisy = random_forces(4, 60.0, -9.0, 11.0), Surroundings(0.015, 0.03)
    fit, held_out = fitted(rehearse(Model(effects=acting), drive, noisy, 4))
    kinds = [ActuatorGain, WheelFrictionAsymmetry, QuadraticDrag]
    path = entered(fit, kinds, held_out)
    return path[0], select(path, kinds, held_out, lambda text: None), held_out


def test_effects_that_hide_each_other_are_found_together(
    hiding: tuple[Tried, Selection, Held],
) -> None:
    first, found, _ = hiding
    assert first.best is None
    assert set(found.support) == {'actuator_gain', 'wheel_friction_asymmetry'}
    outcomes = {told.kind.name: told.outcome for told in found.trials}
    assert outcomes == {**dict.fromkeys(found.support, SUPPORTED), 'quadratic_drag': CHANCE}


def test_what_was_hidden_goes_with_what_hid_it(hiding: tuple[Tried, Selection, Held]) -> None:
    _, found, held_out = hiding
    assert found.withdrawn('actuator_gain', held_out, OUTDONE).support == {}


def test_what_is_found_counts_the_shapes_tried() -> None:
    drifting = Model(effects=(FrictionDrift(0.3, 0.0, 20.0),))
    fit, held_out = fitted(rehearse(drifting, random_forces(3, 60.0, -9.0, 11.0), SMOOTH, 3))
    path = entered(fit, [FrictionDrift], held_out)
    found = select(path, [FrictionDrift], held_out, lambda text: None)
    (trial,), (rest,), (told,) = found.trials, found.without.values(), found.support.values()
    assert trial.looks > 1
    alone = compare(rest, found.final, held_out)
    assert told.p_block == pytest.approx(trial.looks * alone.p_block)
