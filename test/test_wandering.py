"""What intervals owe to a way that adds up the noise of the twists."""

from dataclasses import replace

import numpy as np
import pytest
from fits import SMOOTH, without_pose
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.identification.conclusions.uncertainty import estimates
from diffbot_sim.identification.conclusions.wandering import wandering
from diffbot_sim.identification.fitting.coordinates import Space, point_of
from diffbot_sim.identification.fitting.fit import FIRST_GAINS, Fit, fit_prediction
from diffbot_sim.identification.recordings.stretches import split
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects import Effect
from diffbot_sim.physics.effects.quadratic_drag import QuadraticDrag
from diffbot_sim.physics.effects.slope import Slope
from diffbot_sim.physics.effects.wheel_ripple import WheelRipple
from diffbot_sim.records import Array, Run

RIPPLE = WheelRipple(5.3, 0.5, 0.0, 0.2, 0.4)
(SCALE,) = {spec.scale for spec in WheelRipple.specs() if spec.unit == 'N'}  # of a coordinate


def posed(effect: Effect, seed: int = 1, around: Surroundings = SMOOTH) -> Run:
    """Return a drive whose pose tells the way."""
    forces = random_forces(seed, 60.0, -9.0, 11.0)
    return rehearse(Model(effects=(effect,)), forces, around, seed)


def driven(effect: Effect, seed: int = 1, around: Surroundings = SMOOTH) -> Run:
    """Return the same without a pose: the way is what the twists add up to."""
    return without_pose(posed(effect, seed, around))


def fitted(effect: Effect, run: Run) -> Fit:
    """Return a fit of an effect that begins at the truth."""
    space = Space(Model(), (type(effect),))
    start = np.append(Space(Model(), ()).prior(), point_of(type(effect), effect.values))
    return fit_prediction(space, split([run])[0], start, FIRST_GAINS)


def test_way_that_a_pose_tells_leads_nothing_astray() -> None:
    fit = fitted(RIPPLE, posed(RIPPLE))
    assert not wandering(fit, fit.jacobian).any()


def test_what_hangs_on_no_way_is_as_certain_as_before() -> None:
    fit = fitted(QuadraticDrag(6.0), driven(QuadraticDrag(6.0)))
    assert wandering(fit, fit.jacobian) == pytest.approx(0.0, abs=1e-12)


def test_phase_of_a_ripple_wanders_with_the_angle_of_its_wheel() -> None:
    fit = fitted(RIPPLE, driven(RIPPLE))
    (stretch,), robot = fit.stretches, fit.model.robot
    phase = [c.name for c in fit.space.coordinates].index('wheel_ripple.right_sin')
    spread = wandering(fit, fit.jacobian[..., [phase]])[0, 0] * SCALE**2
    # White noise of 4 mm/s and 8 mrad/s adds up; of its last variance the mean has a third.
    speed = 0.004**2 + (fit.model.half_separation * 0.008) ** 2
    angle = speed * stretch.interval * stretch.time[-1] / 3.0 / robot.wheel_radius**2
    assert spread == pytest.approx(angle * (5.3 * 0.5) ** 2, rel=0.4)


def test_noise_that_cancels_leads_hardly_astray() -> None:
    """Encoders make up for what they rounded off, the sample before."""
    run = driven(RIPPLE, around=Surroundings(1e-4, 1e-4))
    noise = np.random.default_rng(1).normal(0.0, 0.004, (len(run.odometry.time) + 1, 2))

    def astray(added: Array) -> float:
        odometry = replace(run.odometry, twist=run.odometry.twist + added)
        fit = fitted(RIPPLE, replace(run, odometry=odometry))
        return float(np.trace(wandering(fit, fit.jacobian)))

    assert astray(np.diff(noise, axis=0)) < 0.1 * astray(np.sqrt(2.0) * noise[1:])


@pytest.mark.parametrize('effect', [RIPPLE, Slope(0.02, 0.01)], ids=['ripple', 'slope'])
def test_intervals_hold_the_truth_though_the_way_wanders(effect: Effect) -> None:
    held = []
    for seed in range(4):
        told = estimates(fitted(effect, driven(effect, seed)))
        own = [told[f'{effect.name}.{spec.name}'] for spec in effect.specs()]
        held += [it.low <= v <= it.high for it, v in zip(own, effect.values, strict=True)]
    assert np.mean(held) >= 0.9
