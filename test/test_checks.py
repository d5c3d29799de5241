"""What nothing follows from is refused before anything is fitted."""

from dataclasses import replace

import numpy as np
import pytest
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.errors import DataError
from diffbot_sim.identification.recordings.checks import check
from diffbot_sim.identification.recordings.recordings import Recordings
from diffbot_sim.identification.recordings.stretches import split, whole
from diffbot_sim.physics import Model
from diffbot_sim.records import Run

DRIVEN = rehearse(Model(), random_forces(1, 40.0, -9.0, 11.0), Surroundings(), 1)
NOISE = np.random.default_rng(2).normal(0.0, [0.004, 0.008], DRIVEN.odometry.twist.shape)


def standing(run: Run, begin: float, end: float) -> Run:
    """Return a run in which the robot stands from one moment to another [s]."""
    seen = run.odometry
    stands = (seen.time >= begin) & (seen.time < end)
    twist = np.where(stands[:, None], NOISE, seen.twist)
    return replace(run, odometry=replace(seen, twist=twist))


def every(run: Run, group: int, count: int) -> Run:
    """Return a run with one of so many odometry samples, and no more than a count."""
    seen = run.odometry
    part = slice(None, count * group, group)
    less = replace(seen, time=seen.time[part], twist=seen.twist[part], pose=None)
    return replace(run, odometry=less)


def test_drive_is_taken() -> None:
    check(*split([DRIVEN]))


def test_forces_that_are_all_zero_are_refused() -> None:
    given = replace(DRIVEN.commands, force=np.zeros_like(DRIVEN.commands.force))
    with pytest.raises(DataError, match='all forces are 0'):
        check(*split([replace(DRIVEN, commands=given)]))


def test_odometry_that_stands_still_while_it_moves_is_refused() -> None:
    frozen = np.tile(DRIVEN.odometry.twist[1000], (len(DRIVEN.odometry.time), 1))
    with pytest.raises(DataError, match='tells the same twist throughout'):
        check(*split([replace(DRIVEN, odometry=replace(DRIVEN.odometry, twist=frozen))]))


@pytest.mark.parametrize(('begin', 'where'), [(0.0, 'is fitted'), (25.0, 'is held out')])
def test_robot_that_shows_nothing_but_noise_is_refused(begin: float, where: str) -> None:
    with pytest.raises(DataError, match=f'never moves in what {where}'):
        check(*split([standing(DRIVEN, begin, 100.0)]))


def test_no_run_at_all_is_refused() -> None:
    with pytest.raises(DataError, match='no run was given'):
        check((), ())


def test_run_too_short_to_judge_by_is_refused() -> None:
    with pytest.raises(DataError, match=r'30 odometry samples.* are too few'):
        whole([every(DRIVEN, 1, 30)])


def test_less_is_held_out_only_where_it_is_enough() -> None:
    allowed = [Recordings((every(DRIVEN, 4, n),), ()).allow_less_held_out for n in (250, 400)]
    assert allowed == [False, True]
