"""What is found missing of MuJoCo robots that differ from the one that the tests drive.

python benchmarks/mujoco_robots.py        a Markdown table
"""

import sys
from argparse import ArgumentParser
from collections.abc import Callable
from pathlib import Path

import mujoco
import numpy as np

sys.path.append(str(Path(__file__).parents[1] / 'test'))

from mujoco_plant import Rig, drive, excitation
from test_identification_mujoco import DECLARED, NOISE

from diffbot_sim.identification import identify
from diffbot_sim.identification.result import Identification

Change = Callable[[mujoco.MjSpec], None]


def as_tested(spec: mujoco.MjSpec) -> None:
    """Leave the robot as it is."""


def default_solver(spec: mujoco.MjSpec) -> None:
    """Take what MuJoCo does when it is told nothing: longer steps, softer contacts and stops."""
    usual = mujoco.MjSpec()
    option = spec.option
    option.timestep, option.integrator = usual.option.timestep, usual.option.integrator
    option.cone, option.impratio = usual.option.cone, usual.option.impratio
    body = usual.worldbody.add_body()
    geom, joint = body.add_geom(), body.add_joint()
    for own in spec.geoms:
        own.solref, own.solimp = geom.solref, geom.solimp
    for own in _hinges(spec):
        own.solref_friction, own.solimp_friction = joint.solref_friction, joint.solimp_friction


def heavy_rotors(spec: mujoco.MjSpec) -> None:
    """Let rotors behind gears add to the wheels' inertia: 0.8 kg each, seen at the rim."""
    for joint in _hinges(spec):
        joint.armature = 0.005


def slippery_floor(spec: mujoco.MjSpec) -> None:
    """Let tyres grip with 0.3 of what they carry."""
    for geom in _geoms(spec, condim=3):
        geom.friction = [0.3, 0.005, 0.0001]


def disc_wheels(spec: mujoco.MjSpec) -> None:
    """Make discs of the wheels, 30 mm wide: they scrub when the robot turns."""
    for geom in _geoms(spec, condim=3):
        geom.type = mujoco.mjtGeom.mjGEOM_CYLINDER
        geom.size = [geom.size[0], 0.015, 0.0]
        geom.quat = [np.sqrt(0.5), np.sqrt(0.5), 0.0, 0.0]


def rubbing_casters(spec: mujoco.MjSpec) -> None:
    """Let the casters rub with 0.05 of what they carry."""
    for geom in _geoms(spec, condim=1):
        geom.condim, geom.friction = 3, [0.05, 0.0, 0.0]


CHANGES: tuple[Change, ...] = (
    as_tested,
    default_solver,
    heavy_rotors,
    slippery_floor,
    disc_wheels,
    rubbing_casters,
)


def answer(change: Change) -> Identification:
    """Drive a changed robot twice, identify the first drive, judge by the second."""
    train, validate = (
        drive(Rig(), excitation(seed, duration), NOISE, seed, change=change)
        for seed, duration in ((1, 90.0), (2, 60.0))
    )
    return identify([train], DECLARED, [validate])


def _geoms(spec: mujoco.MjSpec, condim: int) -> list[mujoco.MjsGeom]:
    return [geom for geom in spec.geoms if geom.condim == condim]


def _hinges(spec: mujoco.MjSpec) -> list[mujoco.MjsJoint]:
    return [joint for joint in spec.joints if joint.type == mujoco.mjtJoint.mjJNT_HINGE]


def _line(change: Change, found: Identification) -> str:
    names = ', '.join(f'`{effect.name}`' for effect in found.effects) or found.verdict
    floor = found.errors.noise_floor.v_rmse
    before, after = (
        getattr(found.errors, which).v_rmse / floor for which in ('recalibrated', 'with_effects')
    )
    return f'| {change.__name__.replace("_", " ")} | {names} | {before:.2f} | {after:.2f} |'


def main() -> None:
    """Print a line for each robot as it is ready."""
    ArgumentParser(description=__doc__.splitlines()[0]).parse_args()
    print('| robot | found | error before / noise | error after / noise |\n|---|---|---|---|')
    for change in CHANGES:
        print(_line(change, answer(change)), flush=True)


if __name__ == '__main__':
    main()
