"""Commands that were lost: speed is told by the samples after them, and no model is blamed."""

from dataclasses import replace

import numpy as np
import pytest
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.identification.fitting.fit import FIRST_GAINS
from diffbot_sim.identification.fitting.predictor import NO_GAIN, predict
from diffbot_sim.identification.recordings.stretches import thin, whole
from diffbot_sim.identification.recordings.unheard import unheard
from diffbot_sim.physics.effects.actuator_delay import ActuatorDelay
from diffbot_sim.physics.model import Model
from diffbot_sim.physics.schedule import scheduled
from diffbot_sim.records import Commands, Run

WHOLE = rehearse(Model(), random_forces(5, 60.0, -12.0, 14.0), Surroundings(), 5)
TIME, COUNT = WHOLE.odometry.time, len(WHOLE.odometry.time)
NOW = (False, False)
AT = np.arange(100, COUNT, 100)  # where a command is lost


def with_losses(run: Run, error: float) -> Run:
    """Return a run of which some forces are wrong by so much [N], and known to be unsure."""
    force, unsure = run.commands.force.copy(), np.zeros((COUNT, 2))
    sign = np.random.default_rng(2).choice([-1.0, 1.0], (len(AT), 2))
    force[AT] += error * sign
    unsure[AT] = error**2 * (TIME[1] - TIME[0])
    return replace(run, commands=Commands(run.commands.time, force, unsure))


LOST = with_losses(WHOLE, 20.0)


def errors(run: Run, gains: np.ndarray = FIRST_GAINS) -> np.ndarray:
    (stretch,) = whole([run])
    return predict(Model(), stretch, gains).innovation


def test_errors_count_alike_where_nothing_was_lost():
    regained, weight = unheard(WHOLE.commands, TIME, WHOLE.odometry.twist, NOW)
    assert not regained.any()
    assert np.all(weight == 1.0)


def test_speed_is_told_by_more_samples_the_longer_ago_a_command_was_lost():
    regained, _ = unheard(LOST.commands, TIME, LOST.odometry.twist, NOW)
    after = regained[AT[0] + 1 : AT[0] + 90]
    assert np.all(np.diff(after, axis=0) < 0.0)
    assert after[50] == pytest.approx([1.0 / 52.0] * 2, rel=0.1)


def test_errors_of_odometry_without_noise_count_where_nothing_was_lost():
    still = unheard(LOST.commands, TIME, np.zeros((COUNT, 2)), NOW)
    assert np.all(still.weight[: AT[0]] == 1.0)
    assert np.all(np.isfinite(still.regained))


def test_errors_before_the_first_loss_count_in_full():
    regained, weight = unheard(LOST.commands, TIME, LOST.odometry.twist, NOW)
    assert not regained[: AT[0]].any()
    assert np.all(weight[: AT[0]] == 1.0)


def test_errors_after_a_loss_scatter_as_others_do():
    after = (AT[:-1, None] + np.arange(1, 20)).ravel()
    scatter = errors(LOST)[after].std(axis=0) / errors(WHOLE)[after].std(axis=0)
    assert np.all((scatter > 0.7) & (scatter < 1.2))


def test_losses_that_nobody_told_scatter_more():
    untold = replace(LOST, commands=replace(LOST.commands, unsure=None))
    after = (AT[:-1, None] + np.arange(1, 20)).ravel()
    scatter = errors(untold)[after].std(axis=0) / errors(WHOLE)[after].std(axis=0)
    assert np.all(scatter > 1.5)


def test_a_simulation_is_corrected_by_nothing():
    untold = replace(LOST, commands=replace(LOST.commands, unsure=None))
    np.testing.assert_array_equal(errors(LOST, NO_GAIN), errors(untold, NO_GAIN))


def silent(run: Run, since: int, until: int) -> Run:
    """Return a run of which a command is held in place of those that were lost."""
    force, unsure = run.commands.force.copy(), np.zeros((COUNT, 2))
    force[since:until] = force[since - 1]
    unsure[since:until] = force.var(axis=0) * (TIME[until] - TIME[since])
    return replace(run, commands=Commands(run.commands.time, force, unsure))


@pytest.mark.parametrize('means', [(False, False), (True, True)])
def test_after_a_silence_the_robot_moves_as_it_is_seen(means):
    quiet, told = silent(WHOLE, 1000, 1100), WHOLE.odometry.twist.copy()
    told[1:] -= np.where(means, 0.5, 0.0) * np.diff(told, axis=0)
    seen = replace(quiet.odometry, twist=told, means=means)
    (stretch,) = whole([replace(quiet, odometry=seen)])
    found = predict(Model(), stretch, FIRST_GAINS)
    missed = found.twist[1100:1110] - WHOLE.odometry.twist[1100:1110]
    assert np.all(np.abs(missed.mean(axis=0)) < 2.0 * np.array([0.004, 0.008]))


def test_a_robot_that_stood_when_commands_were_lost_is_seen_to_move():
    standing = silent(WHOLE, 1000, 1100)
    still = np.zeros((100, 2))
    force = np.concatenate([standing.commands.force[:1000], still, standing.commands.force[1100:]])
    (stretch,) = whole([replace(standing, commands=replace(standing.commands, force=force))])
    found = predict(Model(), stretch, FIRST_GAINS).twist[1010:1100]
    seen = WHOLE.odometry.twist[1010:1100]
    assert np.sqrt(np.mean((found - seen) ** 2)) < 0.1 * np.sqrt(np.mean(seen**2))


def test_what_is_unsure_comes_as_late_as_its_command():
    late = scheduled(Model(effects=(ActuatorDelay(0.1),)), LOST.commands, 0.0)
    np.testing.assert_array_equal(late.unsure, LOST.commands.unsure)


def test_what_is_unsure_of_an_impulse_stays_so_in_slower_commands():
    fast = replace(LOST, commands=replace(LOST.commands, time=LOST.commands.time / 10.0))
    taken = thin(fast).commands
    assert len(taken.time) < 0.5 * COUNT
    lasting = np.diff(taken.time)[:, None]
    given = np.diff(fast.commands.time)[:, None]
    kept, there = (
        (held * it.unsure[:-1]).sum(axis=0)
        for held, it in ((lasting, taken), (given, fast.commands))
    )
    assert kept == pytest.approx(there)
