"""Files: their names as text, and what is written whole or not at all."""

import pytest

from diffbot_sim.files import spelled, write_whole


def test_name_that_is_no_utf_8_is_text_that_any_file_may_hold():
    told = spelled(b'b\xfcro'.decode('utf-8', 'surrogateescape'))
    assert told.encode('utf-8').decode('utf-8') == 'b\ufffdro'
    assert spelled('büro') == 'büro'


def test_what_cannot_be_written_leaves_nothing_and_what_was_there(tmp_path):
    (tmp_path / 'report').mkdir()
    with pytest.raises(OSError, match='report'):
        write_whole(tmp_path / 'report', 'new')
    assert [file.name for file in tmp_path.iterdir()] == ['report']
