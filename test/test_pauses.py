"""Recordings that pause: what lies between the holes is known, how it goes on is not."""

import json
from dataclasses import replace

import numpy as np
import pytest
from drives import ODOM, START, drive, messages, stamped
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.__main__ import main
from diffbot_sim.bags import read_run, write_run
from diffbot_sim.bags.folder import Message, write_bag
from diffbot_sim.config import save_model
from diffbot_sim.identification.recordings.parts import between
from diffbot_sim.physics import Model
from diffbot_sim.records import Commands, Odometry, Run

PAUSES = ((14.0, 15.5), (33.0, 37.0))
WHOLE = rehearse(Model(), random_forces(3, 60.0, -9.0, 11.0), Surroundings(), 3)


def without(time: np.ndarray) -> np.ndarray:
    """Return which times lie in no pause."""
    return ~np.any([(time > begin) & (time < end) for begin, end in PAUSES], axis=0)


def paused(run: Run) -> Run:
    given, seen = run.commands, run.odometry
    heard, told = without(given.time), without(seen.time)
    return replace(
        run,
        commands=Commands(given.time[heard], given.force[heard]),
        odometry=Odometry(seen.time[told], seen.twist[told], seen.pose[told]),
    )


def test_run_is_parted_at_its_pauses():
    names = [part.name for part in between(paused(WHOLE), PAUSES)]
    assert names == [f'{WHOLE.name} from {since} s on' for since in (0, 16, 37)]


def test_time_goes_on_in_the_parts_of_a_run():
    parts = between(paused(WHOLE), PAUSES)
    time = np.concatenate([part.odometry.time for part in parts])
    np.testing.assert_array_equal(time, paused(WHOLE).odometry.time)


def test_part_that_is_too_short_is_left_out():
    early = ((3.0, 4.0), *PAUSES)
    assert len(between(WHOLE, early)) == 3
    assert between(WHOLE, early)[0].odometry.time[0] >= 4.0


def test_run_of_short_parts_alone_stays_whole():
    often = [(float(since), since + 0.5) for since in range(2, 60, 2)]
    (alone,) = between(WHOLE, often)
    assert alone is WHOLE


def test_run_without_a_pause_stays_as_it_is():
    (alone,) = between(WHOLE, ())
    assert alone is WHOLE


def test_parts_are_told_and_identified_together(tmp_path, capsys):
    write_run(tmp_path / 'drive', paused(WHOLE), START)
    heavier = replace(Model(), robot=replace(Model().robot, mass=12.0))
    save_model(heavier, tmp_path / 'robot.yaml')
    main(f'identify {tmp_path}/drive --params {tmp_path}/robot.yaml --out {tmp_path}/out'.split())
    assert 'taken as: drive from 0 s on, drive from 16 s on' in capsys.readouterr().err
    report = json.loads((tmp_path / 'out' / 'report.json').read_text())
    assert report['verdict'] == 'nothing_missing'


def later(message: Message) -> Message:
    """Return a message of four seconds later."""
    stamp = message.stamp + 4 * 10**9
    return stamped(message._replace(stamp=stamp), stamp)


def test_pause_of_all_topics_is_found(tmp_path):
    told = messages(drive())
    write_bag(tmp_path / 'drive', [*told[:150], *map(later, told[150:])])
    ((begin, end),) = read_run(tmp_path / 'drive').pauses
    assert (begin, end) == pytest.approx((0.49, 4.5))


def test_hole_of_the_odometry_alone_is_no_pause(tmp_path):
    slow = [stamped(m, START + 10 * (m.stamp - START)) for m in messages(drive())]
    kept = [m for i, m in enumerate(slow) if m.topic != ODOM or not 90 < i < 180]
    write_bag(tmp_path / 'drive', kept)
    found = read_run(tmp_path / 'drive')
    assert 'has holes: 3.1 s from 2.9 s on' in found.notes[0]
    assert found.pauses == ()
