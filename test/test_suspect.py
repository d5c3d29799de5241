"""Recordings that can be read, and in which something is mistaken: people are told."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from drives import LEFT, ODOM, RIGHT, messages, stamped
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.bags import read_run
from diffbot_sim.bags.folder import write_bag
from diffbot_sim.bags.write import write_run
from diffbot_sim.errors import BagError
from diffbot_sim.physics import Model
from diffbot_sim.records import Run

DRIVE = rehearse(Model(), random_forces(3, 30.0, -9.0, 11.0), Surroundings(), 3)


def notes(folder: Path, run: Run) -> str:
    write_run(folder / 'drive', run)
    return '\n'.join(read_run(folder / 'drive').notes)


def with_odometry(**changes: np.ndarray) -> Run:
    return replace(DRIVE, odometry=replace(DRIVE.odometry, **changes))


def test_nothing_is_said_of_a_good_drive(tmp_path):
    assert notes(tmp_path, DRIVE) == ''


def test_nothing_is_said_of_twists_that_are_late_or_of_wheels_that_slip(tmp_path):
    late = np.roll(DRIVE.odometry.twist, 10, axis=0) * [1.2, 1.3]
    assert notes(tmp_path, with_odometry(twist=late)) == ''


def test_a_speed_that_is_told_in_the_frame_of_the_world_is_noticed(tmp_path):
    seen = DRIVE.odometry
    told = np.column_stack([seen.twist[:, 0] * np.cos(seen.pose[:, 2]), seen.twist[:, 1]])
    said = notes(tmp_path, with_odometry(twist=told))
    assert f'twist.linear.x of {ODOM} and what its poses move differ' in said
    assert 'angular.z' not in said


@pytest.mark.parametrize('wrong', [-1.0, 57.3])
def test_a_turn_rate_of_another_sign_or_unit_is_noticed(tmp_path, wrong):
    said = notes(tmp_path, with_odometry(twist=DRIVE.odometry.twist * [1.0, wrong]))
    assert f'twist.angular.z of {ODOM} and what its poses turn differ' in said


def test_one_force_recorded_for_both_wheels_is_noticed(tmp_path):
    given = DRIVE.commands
    same = replace(given, force=given.force[:, [0, 0]])
    said = notes(tmp_path, replace(DRIVE, commands=same))
    assert f'{LEFT} and {RIGHT} hold the same forces though the robot turns' in said


def test_a_robot_that_is_driven_straight_has_the_same_forces(tmp_path):
    force = DRIVE.commands.force[:, [0, 0]]
    straight = rehearse(Model(), replace(DRIVE.commands, force=force), Surroundings(), 3)
    assert notes(tmp_path, straight) == ''


def test_messages_that_were_recorded_twice_count_once(tmp_path):
    items = messages(DRIVE)
    write_bag(tmp_path / 'drive', [item for item in items for _ in range(2)])
    found = read_run(tmp_path / 'drive')
    assert len(found.run.odometry.time) == len(DRIVE.odometry.time)
    assert f'messages of {ODOM} bear the stamp of another; used the last' in found.notes[-1]


def test_stamps_before_zero_are_none(tmp_path):
    items = messages(DRIVE)
    early = [stamped(item, item.stamp - items[0].stamp - 5 * 10**9) for item in items]
    write_bag(tmp_path / 'drive', early)
    found = read_run(tmp_path / 'drive')
    assert found.start_ns == items[0].stamp
    assert 'not all messages are stamped; used the times of receipt' in found.notes[0]


def test_forces_that_no_robot_has_are_refused(tmp_path):
    given = DRIVE.commands
    write_run(tmp_path / 'drive', replace(DRIVE, commands=replace(given, force=1e8 * given.force)))
    with pytest.raises(BagError, match='hold NaN, infinity or numbers beyond'):
        read_run(tmp_path / 'drive')
