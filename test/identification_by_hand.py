"""An identification made by hand, for tests of what is written about it."""

from dataclasses import replace

import numpy as np

from diffbot_sim.identification.result import (
    EFFECTS_FOUND,
    NOTHING_MISSING,
    UNEXPLAINED,
    Candidate,
    Comparison,
    Difference,
    ErrorNorm,
    Errors,
    Estimate,
    FoundEffect,
    Horizon,
    Identification,
    RunCheck,
    Structure,
)
from diffbot_sim.physics.effects import Effect, library, sought_effects
from diffbot_sim.physics.model import Model
from diffbot_sim.physics.robot import Robot
from diffbot_sim.records import Array, Trajectory
from diffbot_sim.report import Origin
from diffbot_sim.report.json_report import json_text
from diffbot_sim.report.page import page_text

NOTES = ('first: odom has holes',)
ORIGIN = Origin(('drives/first', 'drives/second'), (), 'robot.yaml', '2026-11-28', '0.1.0', NOTES)
NOISE = (0.004, 0.008)


def page(result: Identification) -> str:
    """Return the page about an answer."""
    return page_text(result, ORIGIN)


def as_json(result: Identification) -> str:
    """Return report.json about an answer."""
    return json_text(result, ORIGIN)


def found(name: str = 'quadratic_drag', with_pose: bool = True) -> Identification:
    """Return an answer that names one effect of the library."""
    effect = FoundEffect(
        name,
        {
            spec.name: Estimate(0.6 * spec.scale, 0.57 * spec.scale, 0.63 * spec.scale, spec.unit)
            for spec in library()[name].specs()
        },
        {'delta_bic': 812.4, 'p_value': 0.0, 'p_block': 3.2e-7, 'held_out_gain': 0.21},
        alternatives=('slope',),
        separate_by='drive the same speeds at the opposite heading',
    )
    return replace(
        nothing_missing(with_pose),
        verdict=EFFECTS_FOUND,
        effects=(effect,),
        errors=errors(0.031),
        candidates=candidates(name),
        identified=Model().with_effect(_guess(library()[name])),
        comparisons=(comparison(0.03, with_pose), comparison(0.02, with_pose, 'second drive')),
        runs=(check('first drive'), check('second drive')),
        nominal_beside={
            'mass': Estimate(10.011, 9.967, 10.055, 'kg'),
            'mu_viscous': Estimate(0.0402, 0.0371, 0.0433, 's/m'),
        },
        advice=('turn on the spot: yaw friction leaves no trace in this drive',),
    )


def nothing_missing(with_pose: bool = True) -> Identification:
    """Return an answer that adds nothing."""
    mass = Estimate(10.213, 10.171, 10.255, 'kg')
    viscous = Estimate(0.0807, 0.0771, 0.0862, 's/m')
    recalibrated = Model(Robot(mass=10.2))
    return Identification(
        verdict=NOTHING_MISSING,
        effects=(),
        unexplained=None,
        nominal={'mass': mass, 'mu_viscous': viscous},
        errors=errors(0.0041),
        candidates=candidates(''),
        declared=Model(),
        recalibrated=recalibrated,
        identified=recalibrated,
        comparisons=(comparison(0.0, with_pose),),
        horizons=horizons(),
    )


def unexplained(with_pose: bool = True) -> Identification:
    """Return an answer that leaves structure without a name."""
    knots = np.linspace(-np.pi, np.pi, 25)
    curve = 0.8 * np.sin(3.0 * knots)
    structure = Structure(
        'a force along x that depends on the heading', 'v', 'heading', 'heading [rad]', 0.57, 2e-9,
        knots, curve, np.full_like(knots, 0.08),
    )  # fmt: skip
    answer = found(with_pose=with_pose)
    return replace(answer, verdict=UNEXPLAINED, effects=(), unexplained=structure)


def errors(recalibrated: float) -> Errors:
    """Return errors that end near the noise floor."""
    floor = ErrorNorm(*NOISE)
    return Errors(
        'held_out', ErrorNorm(0.052, 0.021), ErrorNorm(recalibrated, 0.0081),
        ErrorNorm(0.0041, 0.0081), floor,
    )  # fmt: skip


def horizons() -> tuple[Horizon, ...]:
    """Return errors that grow with the horizon."""
    ahead = (('one step', 0.02), ('1 s', 1.0), ('5 s', 5.0), ('free-running', None))
    growth = (1.0, 1.1, 1.4, 1.5)
    return tuple(
        Horizon(
            name, seconds, 140, ErrorNorm(0.005 * k**5, 0.01 * k**2),
            ErrorNorm(0.0045 * k**4, 0.009 * k), ErrorNorm(0.0041 * k, 0.0081 * k),
        )
        for (name, seconds), k in zip(ahead, growth, strict=True)
    )  # fmt: skip


def check(name: str, mass: float | None = None) -> RunCheck:
    """Return a run that agrees, or one that has another mass than the others."""
    here = Estimate(mass or 10.0, (mass or 10.0) - 0.1, (mass or 10.0) + 0.1, 'kg')
    difference = Difference('mass', here, Estimate(10.01, 9.96, 10.06, 'kg'))
    return RunCheck(
        name, ErrorNorm(0.0042 if mass is None else 0.098, 0.0083), ErrorNorm(*NOISE),
        () if mass is None else (difference,),
    )  # fmt: skip


def candidates(first: str) -> tuple[Candidate, ...]:
    """Return one trial of each effect, the first one successful; one has no number."""
    names = sorted(sought_effects(), key=lambda name: (name != first, name))
    scores = [812.4, 47.0, *np.linspace(6.0, -9.0, len(names) - 2)]
    outcomes = [
        'entered' if first else 'rejected',
        *['not better than chance on held-out data'] * (len(names) - 1),
    ]
    p_block = [3.2e-7, float('nan'), *np.linspace(0.02, 0.9, len(names) - 2)]
    return tuple(
        Candidate(name, score, 0.0, p, 0.1, outcome)
        for name, score, p, outcome in zip(names, scores, p_block, outcomes, strict=True)
    )


def comparison(missing: float, with_pose: bool, run: str = 'first drive') -> Comparison:
    """Return a stretch in which a fast robot is slower than the models believe."""
    time = np.arange(90.0, 120.0, 0.02)
    truth = _trajectory(time, 0.0)
    noise = np.random.default_rng(1).normal(0.0, NOISE, (len(time), 2))
    twist = truth.twist + noise
    return Comparison(
        run, time, twist, truth.pose if with_pose else None, _trajectory(time, missing + 0.04),
        _trajectory(time, missing), truth, 10.0 * noise,
    )  # fmt: skip


def _trajectory(time: Array, excess: float) -> Trajectory:
    v = 0.8 * np.sin(0.7 * time) + 0.3 * np.sin(2.1 * time)
    v = v + excess * v * np.abs(v)
    omega = 0.9 * np.cos(0.45 * time)
    yaw = np.cumsum(omega) * 0.02
    xy = np.cumsum(0.02 * v[:, None] * np.column_stack([np.cos(yaw), np.sin(yaw)]), axis=0)
    wheels = np.column_stack([v + 0.2 * omega, v - 0.2 * omega])
    angle = np.cumsum(wheels, axis=0) * 0.02 / 0.08
    pose, force = np.column_stack([xy, yaw]), 4.0 * wheels
    return Trajectory(time, np.column_stack([v, omega]), pose, angle, wheels, force, 0.3 * wheels)


def _guess(kind: type[Effect]) -> Effect:
    return kind(*kind.guesses[0])
