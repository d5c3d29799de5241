"""The accuracy benchmark: the methods that ours is compared with solve the same equations."""

import numpy as np
import pytest
from accuracy import BEGIN, END, FOR_COULOMB, FOR_GENERALIZED, error, length, remade
from stick_slip import COULOMB_VISCOUS, GENERALIZED, rolling

CASES = [
    *((GENERALIZED, name) for name in FOR_GENERALIZED if 'tanh' not in name),
    *((COULOMB_VISCOUS, name) for name in FOR_COULOMB),
]


@pytest.mark.parametrize(('model', 'name'), CASES)
def test_every_method_nears_the_reference_where_nothing_sticks(model, name):
    method = (FOR_GENERALIZED if model is GENERALIZED else FOR_COULOMB)[name]
    coarse, fine = (error(method, model, rolling(model), step) for step in (0.02, 0.01))
    assert fine < 0.02
    assert fine < 0.51 * coarse


def test_tanh_nears_the_reference_where_the_robot_never_slows_down():
    """Its error is the start, where friction comes late; it grows with the width."""
    course = rolling(GENERALIZED)
    narrow, wide = (
        error(FOR_GENERALIZED[name], GENERALIZED, course, 0.001)
        for name in ('tanh, 1e-3 m/s', 'tanh, 1e-2 m/s')
    )
    assert narrow < 0.2 * wide < 0.05


def test_tables_go_between_the_marks_and_nowhere_else():
    text = f'before\n{BEGIN}old\n{END}after\n'
    assert remade(text, 'new') == f'before\n{BEGIN}\nnew\n{END}after\n'
    assert remade(remade(text, 'old'), 'new') == remade(text, 'new')


@pytest.mark.parametrize(
    ('metres', 'words'),
    [(0.0, '0 m'), (216.4, '220 m'), (1.42e-8, '14 nm'), (1e-3, '1 mm'), (3e-14, '< 1 pm')],
)
def test_lengths_have_two_digits_and_a_unit(metres, words):
    assert length(metres) == words
    assert length(np.float64(metres)) == words
