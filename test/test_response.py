"""The predictor made linear: what small pushes add to its errors."""

from dataclasses import replace

import numpy as np
import pytest

from diffbot_sim.identification.fitting.fit import FIRST_GAINS
from diffbot_sim.identification.fitting.predictor import predict
from diffbot_sim.identification.fitting.response import response
from diffbot_sim.identification.recordings.stretches import Stretch, whole
from diffbot_sim.identification.recordings.unheard import unheard
from diffbot_sim.physics.effects.actuator_lag import ActuatorLag
from diffbot_sim.physics.effects.slope import Slope
from diffbot_sim.physics.effects.yaw_friction import YawFriction
from diffbot_sim.physics.model import Model
from diffbot_sim.physics.simulation import simulate
from diffbot_sim.records import Commands, Odometry, Run

TIME = np.arange(1000) / 50.0
FORCE = 0.1


def driven(model: Model, forces, means=(False, False)) -> Stretch:
    """Return a drive by these forces, without noise."""
    commands = Commands(TIME, np.ascontiguousarray(forces))
    moved = simulate(model, commands, TIME)
    told = Odometry(TIME, moved.twist, moved.pose, means)
    (stretch,) = whole([Run('drive', commands, told)])
    return stretch


def wandering(mean: float, seed: int = 0):
    """Return forces about a mean that differ between the wheels."""
    steps = np.random.default_rng(seed).normal(mean, 1.0, (50, 2))
    return np.repeat(steps, 20, axis=0)


def difference(model: Model, stretch: Stretch, push, of: str = 'innovation'):
    """Return what a push adds to something predicted, half of its way back and forth."""
    more, less = (
        getattr(predict(model, stretch.pushed(sign * FORCE * push), FIRST_GAINS), of)
        for sign in (1, -1)
    )
    return (more - less) / (2.0 * FORCE)


@pytest.mark.parametrize('means', [(False, False), (True, True), (True, False)])
@pytest.mark.parametrize(
    'effects', [(), (Slope(0.02, 0.01), ActuatorLag(0.08)), (YawFriction(0.5),)]
)
def test_a_rolling_robot_answers_as_the_predictor_does(effects, means) -> None:
    model = Model(effects=effects)
    stretch = driven(model, wandering(8.0) + np.array([2.0, -2.0]), means)
    push = np.random.default_rng(1).normal(size=(1000, 2)).cumsum(axis=0) / 30.0
    linear = response(model, stretch, FIRST_GAINS, FORCE).errors(push[..., None])[..., 0]
    wanted = difference(model, stretch, push)
    assert np.linalg.norm(linear - wanted) < 0.02 * np.linalg.norm(wanted)


def test_a_robot_whose_commands_were_lost_answers_as_the_predictor_does() -> None:
    stretch = driven(Model(), wandering(8.0))
    unsure = np.where(np.arange(1000) % 150 == 90, 0.05, 0.0)[:, None] * np.ones(2)
    noisy = stretch.twist + np.random.default_rng(3).normal(0.0, 0.005, (1000, 2))
    lost = unheard(replace(stretch.run.commands, unsure=unsure), TIME, noisy, (False, False))
    stretch = replace(stretch, unheard=lost)
    assert lost.weight.min() < 0.5
    push = np.random.default_rng(1).normal(size=(1000, 2)).cumsum(axis=0) / 30.0
    linear = response(Model(), stretch, FIRST_GAINS, FORCE).errors(push[..., None])[..., 0]
    wanted = difference(Model(), stretch, push)
    assert np.linalg.norm(linear - wanted) < 0.02 * np.linalg.norm(wanted)


def test_noise_model_follows_a_push_as_in_the_predictor() -> None:
    stretch = driven(Model(), wandering(8.0))
    push = np.random.default_rng(1).normal(size=(1000, 2)).cumsum(axis=0) / 30.0
    answer = response(Model(), stretch, FIRST_GAINS, FORCE)
    linear = answer.followed(answer.errors(push[..., None]))[..., 0]
    wanted = difference(Model(), stretch, push, 'disturbance')
    assert np.linalg.norm(linear - wanted) < 0.02 * np.linalg.norm(wanted)


def test_a_robot_held_by_friction_does_not_answer() -> None:
    stretch = driven(Model(), np.full((1000, 2), 0.5))
    push = np.ones((1000, 2, 1))
    assert np.all(response(Model(), stretch, FIRST_GAINS, FORCE).errors(push) == 0.0)


def test_a_robot_that_only_the_push_of_its_stretch_moves_answers_as_the_predictor_does() -> None:
    stretch = replace(
        driven(Model(), np.full((1000, 2), 0.5)), push=np.full((1000, 2), [9.0, 0.2])
    )
    push = np.random.default_rng(1).normal(size=(1000, 2)).cumsum(axis=0) / 30.0
    linear = response(Model(), stretch, FIRST_GAINS, FORCE).errors(push[..., None])[..., 0]
    wanted = difference(Model(), stretch, push)
    assert np.linalg.norm(linear - wanted) < 0.02 * np.linalg.norm(wanted)


def test_errors_before_a_push_do_not_know_of_it() -> None:
    stretch = driven(Model(), wandering(8.0))
    push = np.zeros((1000, 2, 1))
    push[500] = 1.0
    errors = response(Model(), stretch, FIRST_GAINS, FORCE).errors(push)
    assert np.all(errors[:501] == 0.0)
    assert np.all(errors[501] != 0.0)


def test_pushes_add_up() -> None:
    stretch = driven(Model(), wandering(0.0))
    pushes = np.random.default_rng(1).normal(size=(1000, 2, 3))
    answer = response(Model(), stretch, FIRST_GAINS, FORCE)
    together = answer.errors(pushes @ np.array([[1.0], [2.0], [-3.0]]))
    assert together == pytest.approx(answer.errors(pushes) @ np.array([[1.0], [2.0], [-3.0]]))
