"""What lets an effect in."""

from dataclasses import replace
from math import nan

import numpy as np
import pytest

from diffbot_sim.identification.selection.evidence import Evidence
from diffbot_sim.identification.selection.trials import (
    NEEDLESS,
    SUPPORTED,
    UNCONFIRMED,
    judge,
    judge_again,
)
from diffbot_sim.identification.statistics.blocks import informative_blocks
from diffbot_sim.identification.statistics.guards import elsewhere

CLEAR = Evidence(60.0, 1e-15, 0.004, 0.05, 0.001, 0.001)


def test_effect_with_all_evidence_enters() -> None:
    assert judge(CLEAR, tried=16) == SUPPORTED


def test_best_of_many_shapes_must_be_surer() -> None:
    assert judge(CLEAR.of_best(40), tried=16) == 'not beyond a disturbance that changes slowly'


def test_effect_that_does_not_predict_held_out_data_stays_outside() -> None:
    vague = Evidence(60.0, 1e-15, 0.004, 0.05, 0.4, 0.4)
    assert judge(vague, tried=16) == 'does not predict held-out data better'


def test_effect_stays_only_while_all_evidence_is_for_it() -> None:
    assert judge_again(CLEAR, tried=16) == SUPPORTED
    assert judge_again(replace(CLEAR, p_held_out=0.4, p_folds=0.4), tried=16) == UNCONFIRMED


def test_effect_leaves_where_what_lacks_it_explains_as_much() -> None:
    assert judge_again(replace(CLEAR, delta_bic=8.0), tried=16) == NEEDLESS


def test_parts_of_a_run_may_confirm_what_its_end_leaves_open() -> None:
    short = Evidence(60.0, 1e-15, 0.004, 0.001, 0.4, 0.001)
    assert judge(short, tried=16) == SUPPORTED
    assert judge(short.of_best(40), tried=16) != SUPPORTED


def test_held_out_data_must_not_speak_against_what_parts_of_a_run_tell() -> None:
    lost = Evidence(60.0, 1e-15, 0.004, -0.1, 0.9, 1e-4)
    assert judge(lost, tried=16) == 'does not predict held-out data better'
    silent = replace(lost, held_out_gain=0.0, p_held_out=nan)  # where it does not act at all
    assert judge(silent, tried=16) == SUPPORTED


def test_law_of_time_must_prove_right_at_the_end() -> None:
    wrong = Evidence(500.0, 1e-50, 1e-9, 0.04, 0.6, nan)
    assert judge(wrong, tried=16) == 'does not predict held-out data better'
    assert judge(replace(wrong, p_held_out=0.04), tried=16) == SUPPORTED


def test_one_guard_may_be_less_sure_where_the_other_is_beyond_doubt() -> None:
    assert judge(replace(CLEAR, p_block=0.02, p_folds=1e-5), tried=16) == SUPPORTED
    assert judge(replace(CLEAR, p_block=0.06, p_folds=1e-5), tried=16) != SUPPORTED


def test_witnesses_that_are_half_sure_each_are_sure_together() -> None:
    assert elsewhere(0.06, 0.06) < 0.05 < elsewhere(0.06, nan)
    assert elsewhere(0.5, 0.01) < 0.05 < elsewhere(0.01, 0.5)  # parts of the run are more data


def test_witness_that_proves_nothing_is_not_heard() -> None:
    assert elsewhere(nan, 0.03) == pytest.approx(0.03)
    assert elsewhere(nan, nan) == 1.0


def test_block_that_shows_an_amount_only_now_and_then_knows_of_it() -> None:
    shown = np.zeros((4000, 1))
    shown[::5] = 1.0
    assert informative_blocks(shown) == pytest.approx(40.0)
    shown[2000:] = 0.0
    assert informative_blocks(shown) == pytest.approx(20.0)


def test_one_sample_that_jumps_is_no_block_that_knows_all() -> None:
    shown = np.ones((4000, 1))
    shown[7] = 1e4
    assert informative_blocks(shown) == pytest.approx(40.0)
