"""A robot that stands, and odometry that says it turns."""

from dataclasses import replace

import numpy as np
import pytest

from diffbot_sim.bags.standing import turning
from diffbot_sim.control.rehearsal import Surroundings, rehearse
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects import Effect
from diffbot_sim.physics.effects.force_bias import ForceBias
from diffbot_sim.records import Commands, Run


def drive(bias: float = 0.0, *effects: Effect) -> Run:
    """Stand for 3 s, then drive for 3 s."""
    time = np.arange(600) * 0.01
    force = np.outer(time >= 3.0, [6.0, 5.0])
    run = rehearse(Model(effects=effects), Commands(time, force), Surroundings(), 2)
    twist = run.odometry.twist + np.array([0.0, bias])
    return replace(run, odometry=replace(run.odometry, twist=twist))


@pytest.mark.parametrize('bias', [-0.03, 0.01])
def test_bias_of_a_gyro_shows_while_the_robot_stands(bias: float) -> None:
    assert turning(drive(bias=bias)) == pytest.approx(bias, abs=2e-3)


def test_good_odometry_of_a_standing_robot_is_silent() -> None:
    assert turning(drive()) == 0.0


def test_robot_that_really_moves_without_a_command_has_no_bias() -> None:
    assert turning(drive(0.0, ForceBias(3.0, -3.0))) == 0.0


def test_drive_without_a_rest_tells_nothing() -> None:
    run = drive(bias=0.03)
    pushed = replace(run.commands, force=np.ones_like(run.commands.force))
    assert turning(replace(run, commands=pushed)) == 0.0
