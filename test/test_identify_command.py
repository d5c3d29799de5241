"""`identify`: bags in, report, model and residual out."""

from pathlib import Path

import numpy as np
import pytest
from drives import START, drive
from identification_by_hand import comparison, found
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
    assert 'Effects added: quadratic_drag.' in (out / 'model.yaml').read_text()


def test_runs_and_validation_reach_identification_apart(bag, monkeypatch):
    seen = []
    monkeypatch.setattr(
        identify, 'identify', lambda runs, model, validate, progress: seen.append((runs, validate))
    )
    monkeypatch.setattr(identify, 'save', lambda *results: None)
    monkeypatch.setattr(identify, 'print_summary', lambda result: None)
    assert main([*words(bag), '--validate', str(bag), str(bag)], 'identify') == 0
    ((runs, validate),) = seen
    assert [run.name for run in runs] == ['drive_1']
    assert [run.name for run in validate] == ['drive_2', 'drive_3']


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
    identify.save(found(), tmp_path, recorded, [])
    with Reader(tmp_path / 'residual') as reader:
        assert reader.start_time == START + 90 * 10**9
