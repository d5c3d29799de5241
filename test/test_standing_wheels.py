"""Wheels that stand elsewhere in their turn as each run begins: a ripple tells where."""

from dataclasses import replace
from math import cos, sin

import numpy as np
import pytest
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.identification import Identification, identify
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects.quadratic_drag import QuadraticDrag
from diffbot_sim.physics.effects.wheel_ripple import WheelRipple
from diffbot_sim.records import Run

ORDER = 3.0
# How much further [rad] the right and the left wheel stand in the second run.
FURTHER = (0.5, 1.2)


def seen_after(cosine: float, sine: float, angle: float) -> tuple[float, float]:
    """Return the amplitudes of a ripple on a wheel that begins at an angle [rad]."""
    turn = ORDER * angle
    return cosine * cos(turn) + sine * sin(turn), sine * cos(turn) - cosine * sin(turn)


def run(number: int, right: float, left: float) -> Run:
    """Return a drive of one robot whose wheels stand at some angles as it begins."""
    ripple = WheelRipple(ORDER, *seen_after(0.5, 0.2, right), *seen_after(-0.3, 0.4, left))
    forces = random_forces(number, 35.0, -7.0, 9.0)
    driven = rehearse(Model(effects=(ripple,)), forces, Surroundings(), number)
    return replace(driven, name=f'run {number}')


@pytest.fixture(scope='module')
def found() -> Identification:
    return identify(
        [run(1, 0.0, 0.0), run(2, *FURTHER)], Model(), kinds=(WheelRipple, QuadraticDrag)
    )


def test_ripple_is_one_and_the_same_in_both_runs(found: Identification) -> None:
    (effect,) = found.effects
    told = {name: it.value for name, it in effect.parameters.items()}
    assert told['right_cos'] == pytest.approx(0.5, abs=0.02)
    assert told['left_sin'] == pytest.approx(0.4, abs=0.02)
    assert found.unexplained is None


def test_it_is_told_where_the_wheels_stood(found: Identification) -> None:
    first, second = found.runs
    assert first.wheel_angles == (0.0, 0.0)
    period = 2.0 * np.pi / ORDER
    assert np.array(second.wheel_angles) % period == pytest.approx(np.array(FURTHER), abs=0.02)


def test_wheels_that_began_alike_are_left_as_they_were() -> None:
    alike = identify([run(1, 0.0, 0.0), run(2, 0.0, 0.0)], Model(), kinds=(WheelRipple,))
    assert all(it.wheel_angles == (0.0, 0.0) for it in alike.runs)
