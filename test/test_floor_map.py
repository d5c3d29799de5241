"""The map of the floor in the report."""

from base64 import b64decode
from dataclasses import replace

import identification_by_hand as by_hand
import numpy as np
import pytest

from diffbot_sim.identification.result import Identification
from diffbot_sim.records import Array
from diffbot_sim.report.floor import floor_figures

SPOT = np.array([0.5, -0.2, 0.4])


def on_a_spot(variable: str, with_pose: bool = True) -> Identification:
    answer = by_hand.unexplained(with_pose)
    assert answer.unexplained is not None
    return replace(answer, unexplained=replace(answer.unexplained, variable=variable, spot=SPOT))


def told(answer: Identification, backward: bool) -> Array:
    """Return the colours of a robot at x = 1 m that a force of 1 N pushes ahead or backward."""
    run, sense = answer.comparisons[0], -1.0 if backward else 1.0
    ones = np.ones((len(run.time), 1))
    driven = replace(
        run, pose=ones * [1.0, -0.2, 0.0], twist=ones * [sense, 0.0], disturbance=ones * [1.0, 0.0]
    )
    (figure,) = floor_figures(replace(answer, comparisons=(driven,)))
    return np.frombuffer(b64decode(figure.data[0]['marker']['color']['bdata']))


def test_map_is_drawn_where_what_is_left_depends_on_a_spot() -> None:
    assert 'Where on the floor it acts' in by_hand.page(on_a_spot('patch'))
    assert 'Where on the floor it acts' not in by_hand.page(by_hand.unexplained())


def test_without_a_pose_there_is_no_map() -> None:
    assert floor_figures(on_a_spot('patch', with_pose=False)) == []


@pytest.mark.parametrize(('backward', 'force'), [(False, 1.0), (True, -1.0)])
def test_force_of_a_patch_has_the_sense_of_the_motion(backward: bool, force: float) -> None:
    np.testing.assert_array_equal(told(on_a_spot('patch'), backward), force)


@pytest.mark.parametrize('backward', [False, True])
def test_force_of_a_hill_leads_away_from_its_top(backward: bool) -> None:
    np.testing.assert_array_equal(told(on_a_spot('round_hill'), backward), 1.0)
