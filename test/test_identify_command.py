"""`identify`: bags in, report, model and residual out."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from drives import START, drive
from identification_by_hand import ORIGIN, comparison, found
from rosbags.rosbag2 import Reader

from diffbot_sim.__main__ import main
from diffbot_sim.bags import RecordedRun, write_run
from diffbot_sim.commands import identify
from diffbot_sim.commands._residual import residual_series
from diffbot_sim.config import load_model

SAMPLE = Path(__file__).parents[1] / 'config' / 'diffbot.yaml'


@pytest.fixture
def bag(tmp_path: Path) -> Path:
    write_run(tmp_path / 'drive', drive(), START)
    return tmp_path / 'drive'


def words(bag: Path) -> list[str]:
    return [str(bag), '--params', str(SAMPLE), '--out', str(bag.parent / 'out')]


def test_identify_writes_report_model_and_residual(bag, monkeypatch):
    monkeypatch.setattr(identify, 'identify', lambda *runs, **options: found())
    assert main(words(bag), 'identify') == 0
    out = bag.parent / 'out'
    names = {'report.json', 'report.html', 'model.yaml', 'residual'}
    assert {file.name for file in out.iterdir()} == names
    assert load_model(out / 'model.yaml') == found().identified
    head = (out / 'model.yaml').read_text()
    assert f'{bag}, declared in {SAMPLE}.' in head
    assert 'Effects added: quadratic_drag.' in head


def test_runs_and_validation_reach_identification_apart(bag, monkeypatch):
    seen = []
    monkeypatch.setattr(
        identify, 'identify', lambda runs, model, validate, progress: seen.append((runs, validate))
    )
    monkeypatch.setattr(identify, 'save', lambda *results: None)
    monkeypatch.setattr(identify, 'print_summary', lambda result: None)
    others = [bag.parent / day / 'drive' for day in ('monday', 'tuesday')]
    for day, other in enumerate(others, 1):
        write_run(other, drive(), START + day * 10**9)
    assert main([*words(bag), '--validate', *map(str, others)], 'identify') == 0
    ((runs, validate),) = seen
    assert [run.name for run in runs] == ['drive_1']
    assert [run.name for run in validate] == ['drive_2', 'drive_3']


def test_names_stay_apart_whatever_they_were(bag):
    runs = [RecordedRun(replace(drive(), name=name), START) for name in ('a', 'a_1', 'a')]
    assert [item.run.name for item in identify.distinct(runs)] == ['a_2', 'a_1', 'a_3']


def test_bag_is_not_taken_twice(bag, capsys):
    assert main([*words(bag), '--validate', str(bag)], 'identify') == 1
    assert 'given twice' in capsys.readouterr().err


def test_copy_of_a_bag_is_not_taken_beside_it(bag, capsys):
    copy = bag.parent / 'copy'
    write_run(copy, drive(), START)
    assert main([*words(bag), '--validate', str(copy)], 'identify') == 1
    assert f'{copy}: holds the drive of {bag}' in capsys.readouterr().err


def test_parameter_file_is_not_overwritten_by_the_result(bag, capsys):
    own = bag.parent / 'model.yaml'
    own.write_text(SAMPLE.read_text())
    said = [str(bag), '--params', str(own), '--out', str(bag.parent)]
    assert main(said, 'identify') == 1
    assert 'would take its place' in capsys.readouterr().err
    assert own.read_text() == SAMPLE.read_text()


def test_numbers_that_nobody_gave_are_told(bag, monkeypatch, capsys):
    monkeypatch.setattr(identify, 'identify', lambda *runs, **options: found())
    own = bag.parent / 'own.yaml'
    own.write_text('/**:\n  ros__parameters:\n    robot: {mass: 8.0, wheel_radius: 0.1}\n')
    assert (
        main([str(bag), '--params', str(own), '--out', str(bag.parent / 'out')], 'identify') == 0
    )
    told = [line for line in capsys.readouterr().err.splitlines() if 'is not given' in line]
    assert len(told) == 2
    assert 'robot.wheel_separation is not given; 0.4 m is taken, and not fitted' in told[0]
    assert 'robot.inertia is not given; 0.4 kg·m² is where its fit begins' in told[1]


def test_nothing_is_written_when_identification_fails(bag, monkeypatch):
    monkeypatch.setattr(identify, 'identify', lambda *runs, **options: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        main(words(bag), 'identify')
    assert not (bag.parent / 'out').exists()


def test_the_residual_is_measured_minus_predicted():
    item = comparison(0.03, True)
    series = residual_series([item], {'first drive': 0})
    time, residual = series['/residual/recalibrated/twist']
    np.testing.assert_array_equal(time, item.time)
    np.testing.assert_array_equal(residual, item.twist - item.recalibrated.twist)
    assert set(series) >= {'/measured/twist', '/declared/twist', '/with_effects/twist'}


def test_each_of_several_runs_has_its_namespace_and_its_time():
    starts = {'first drive': 0, 'second drive': 5 * 10**9}
    series = residual_series(found().comparisons, starts)
    assert '/run_1_first_drive/measured/twist' in series
    late = series['/run_2_second_drive/measured/twist'][0]
    np.testing.assert_allclose(late - found().comparisons[1].time, 5.0)


def test_the_residual_bag_is_stamped_like_the_recording(tmp_path):
    recorded = [
        RecordedRun(drive('first drive'), START),
        RecordedRun(drive('second drive'), START),
    ]
    identify.save(found(), ORIGIN, tmp_path, recorded)
    with Reader(tmp_path / 'residual') as reader:
        assert reader.start_time == START + 90 * 10**9


def test_a_model_of_another_hand_is_kept(bag, capsys):
    out = bag.parent / 'out'
    out.mkdir()
    (out / 'model.yaml').write_text('/**: {ros__parameters: {}}')
    assert main(words(bag), 'identify') == 1
    assert 'model.yaml: is of another hand, and is kept' in capsys.readouterr().err


def test_notes_name_runs_as_the_report_does(bag):
    item = RecordedRun(replace(drive(), name='a'), START, ('a: its wheels squeak',))
    told = [renamed.notes for renamed in identify.distinct([item, item])]
    assert told == [('a_1: its wheels squeak',), ('a_2: its wheels squeak',)]
