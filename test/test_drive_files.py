"""Drive files, and the forces that come of them."""

from pathlib import Path

import numpy as np
import pytest

from diffbot_sim.config import load_drive, save_drive
from diffbot_sim.drives import Drive, RandomForces, Segment, SegmentForces, stamps
from diffbot_sim.errors import ConfigError

STEPS = SegmentForces((Segment(2.0, 4.0, 4.0), Segment(3.0, -1.0, 2.5)))


def written(folder: Path, text: str) -> Path:
    path = folder / 'drive.yaml'
    path.write_text(text)
    return path


@pytest.mark.parametrize('drive', [Drive(), Drive(RandomForces(7.0, stops=0.5)), Drive(STEPS, 9)])
def test_a_saved_drive_is_loaded_back(tmp_path, drive):
    save_drive(drive, tmp_path / 'drive.yaml')
    assert load_drive(tmp_path / 'drive.yaml') == drive


def test_an_empty_random_section_holds_the_defaults(tmp_path):
    assert load_drive(written(tmp_path, 'random:')) == Drive()


def test_segments_hold_their_forces_and_those_left_out_are_zero(tmp_path):
    path = written(tmp_path, 'segments: [{until: 2, right: 4.0}, {until: 3.5, left: -1.0}]')
    commands = load_drive(path).forces.commands(0)
    np.testing.assert_array_equal(commands.time, [0.0, 2.0])
    np.testing.assert_array_equal(commands.force, [[4.0, 0.0], [0.0, -1.0]])


def test_random_forces_stay_within_their_bounds_and_repeat_by_seed():
    forces = RandomForces(30.0, 2.0, 3.0, stops=0.0)
    first, same, other = (forces.commands(seed).force for seed in (1, 1, 2))
    assert first.min() >= 2.0
    assert first.max() <= 3.0
    np.testing.assert_array_equal(first, same)
    assert not np.array_equal(first, other)


@pytest.mark.parametrize(('share', 'equal'), [({'stops': 1.0}, 0.0), ({'straight': 1.0}, None)])
def test_shares_of_one_leave_no_other_kind(share, equal):
    kinds = {'straight': 0.0, 'stops': 0.0} | share
    right, left = RandomForces(20.0, **kinds).commands(3).force.T
    np.testing.assert_array_equal(right, left if equal is None else equal)


def test_forces_that_are_hardly_held_still_come_to_an_end():
    commands = RandomForces(2.0, shortest=0.0, longest=0.0, stops=0.0).commands(0)
    assert len(np.unique(commands.force[:, 0])) == len(commands.time) == 100


def test_equal_moments_of_two_rates_have_equal_bits():
    np.testing.assert_array_equal(stamps(7.0, 100.0)[::2], stamps(7.0, 50.0))
    assert stamps(1.1, 10.0)[-1] == 1.0


@pytest.mark.parametrize(
    ('text', 'expected'),
    [
        ('', 'empty. A drive file holds either'),
        ('rate: 50', "holds either 'random:' or 'segments:'"),
        ('{random: , segments: []}', "holds either 'random:' or 'segments:'"),
        ('{random: , rat: 50}', 'rat: unknown key. Known: rate, random, segments. Did you mean'),
        ('{random: , rate: 0}', ': rate: 0 is not valid; rate (rows of the table in a second)'),
        ('random: {mots: 1}', 'random.mots: unknown parameter. Known: duration, least, most'),
        ('random: {on: 3}', 'random.True: unknown parameter. Known: duration, least, most'),
        ('random: {duration: long}', 'takes 0.1 to 10000 s'),
        ('random: {least: 11}', 'random.least: 11 exceeds random.most 10. Lower least or'),
        ('random: {shortest: 3}', 'random.shortest: 3 exceeds random.longest 2.4'),
        ('random: {straight: 0.9}', 'Lower them until their sum is at most 1'),
        ('random: 60', 'random: 60 is no mapping'),
        ('segments: 60', 'segments: 60 is no list'),
        ('segments: []', 'segments: there is none'),
        ('segments: [{right: 1}]', 'segments[0].until: None is not valid'),
        ('segments: [{until: 1}, 5]', 'segments[1]: 5 is no mapping. Its keys: until, right'),
        ('segments: [{until: 2}, {until: 1}]', 'segments[1].until: 1 s is not after 2 s'),
    ],
)
def test_a_wrong_drive_is_named_with_what_is_valid(tmp_path, text, expected):
    with pytest.raises(ConfigError) as caught:
        load_drive(written(tmp_path, text))
    assert str(caught.value).startswith(f'{tmp_path / "drive.yaml"}: ')
    assert expected in str(caught.value)
    assert '\n' not in str(caught.value)


def test_a_drive_file_that_is_not_there_is_told(tmp_path):
    with pytest.raises(ConfigError, match=r'no such file\. Give --drive a YAML file'):
        load_drive(tmp_path / 'nothing.yaml')
