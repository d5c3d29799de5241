"""Identification of a robot whose physics is MuJoCo's, through bags."""

from functools import cache
from math import radians, sin
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from mujoco_plant import Rig, drive, excitation

from diffbot_sim.bags import read_run, write_run
from diffbot_sim.identification import identify
from diffbot_sim.identification.result import Identification
from diffbot_sim.physics import Friction, Model, Robot
from diffbot_sim.records import Run

NOISE = (0.004, 0.008)
RIGS = {
    'as declared': Rig(),
    'tilted floor': Rig(tilt=radians(1.5)),
    'filtered actuator': Rig(lag=0.12),
}
# What its owner believes: every figure is 5 to 20 % off.
DECLARED = Model(
    Robot(mass=9.6, inertia=0.38, wheel_separation=0.4, wheel_radius=0.08),
    Friction(normal_force=49.05, mu_static=0.044, mu_coulomb=0.037, mu_viscous=0.09),
)


@cache
def answer(case: str) -> Identification:
    """Drive twice, identify the first drive, judge by the second."""
    with TemporaryDirectory() as folder:
        train = recorded(Path(folder), case, 1, 60.0)
        validate = recorded(Path(folder), case, 2, 45.0)
    return identify([train], DECLARED, [validate])


def recorded(folder: Path, case: str, seed: int, duration: float) -> Run:
    """Drive the robot of a case and return what its bag says."""
    bag = folder / str(seed)
    write_run(bag, drive(RIGS[case], excitation(seed, duration), NOISE, seed))
    return read_run(bag).run


def test_nothing_is_missing_where_nothing_is_hidden() -> None:
    assert answer('as declared').verdict == 'nothing_missing'


def test_tilted_floor_is_found_with_its_tilt() -> None:
    found = answer('tilted floor').effects[0]
    assert found.name == 'slope'
    # Gravity pulls on the mass, not on the spin of the wheels that adds to it.
    rig = RIGS['tilted floor']
    grade = sin(rig.tilt) * rig.mass / rig.equivalent().robot.mass
    assert found.parameters['grade_x'].value == pytest.approx(grade, rel=0.05)
    assert found.parameters['grade_y'].value == pytest.approx(0.0, abs=0.05 * grade)


def test_filtered_actuator_is_found_with_its_time_constant() -> None:
    found = answer('filtered actuator').effects[0]
    assert found.name == 'actuator_lag'
    assert found.parameters['time_constant'].value == pytest.approx(0.12, rel=0.05)


@pytest.mark.parametrize('case', ['tilted floor', 'filtered actuator'])
def test_found_effect_brings_the_error_down_to_that_of_the_complete_model(case: str) -> None:
    complete, mended = answer('as declared').errors, answer(case).errors
    assert mended.with_effects.v_rmse < 1.12 * complete.with_effects.v_rmse
    assert mended.with_effects.omega_rmse < 1.12 * complete.with_effects.omega_rmse
    assert mended.recalibrated.v_rmse > 1.5 * mended.with_effects.v_rmse
