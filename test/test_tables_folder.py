"""The folder of a data set: replaced as a whole, never at the cost of something else."""

from pathlib import Path

import pytest

from diffbot_sim.errors import DiffbotError
from diffbot_sim.tables import check_replaceable, replacing, write_manifest


def data_set(folder: Path, *runs: str) -> None:
    with replacing(folder) as place:
        for name in runs:
            (place / name).write_text(name)
        write_manifest(place, 0, dict.fromkeys(runs, 1))


def broken_off(folder: Path, problem: BaseException) -> None:
    with replacing(folder) as place:
        (place / 'run_0000.npz').write_text('half of a run')
        raise problem


def names(folder: Path) -> list[str]:
    return sorted(item.name for item in folder.iterdir())


def test_a_data_set_replaces_an_earlier_one_and_leaves_other_files(tmp_path):
    data_set(tmp_path / 'set', 'run_0000.npz', 'run_0001.npz')
    (tmp_path / 'set' / 'run_notes.txt').write_text('mine')
    data_set(tmp_path / 'set', 'run_0000.parquet')
    assert names(tmp_path / 'set') == ['manifest.json', 'run_0000.parquet', 'run_notes.txt']


def test_a_failure_leaves_the_earlier_data_set_as_it_was(tmp_path):
    data_set(tmp_path, 'run_0000.npz')
    with pytest.raises(KeyboardInterrupt):
        broken_off(tmp_path, KeyboardInterrupt())
    assert names(tmp_path) == ['manifest.json', 'run_0000.npz']
    assert (tmp_path / 'run_0000.npz').read_text() == 'run_0000.npz'


@pytest.mark.parametrize('name', ['metadata.yaml', 'run_0000.npz', 'manifest.json'])
def test_what_is_no_data_set_is_kept(tmp_path, name):
    (tmp_path / name).write_text('{"made_by": "somebody"}')
    with pytest.raises(DiffbotError, match='no data set, which is kept'), replacing(tmp_path):
        pass
    assert names(tmp_path) == [name]


def test_a_new_an_empty_and_a_hidden_one_are_free(tmp_path):
    check_replaceable(tmp_path / 'new')
    check_replaceable(tmp_path)
    (tmp_path / '.gitkeep').touch()
    check_replaceable(tmp_path)


def test_a_fault_while_writing_is_told_with_the_folder(tmp_path):
    with pytest.raises(DiffbotError, match=r'set: cannot be written: No space left on device\.'):
        broken_off(tmp_path / 'set', OSError(28, 'No space left on device'))
