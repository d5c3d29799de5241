"""Parameters: one declaration says name, unit, bounds and meaning, and refuses what is wrong."""

from dataclasses import dataclass
from math import inf, isfinite, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from diffbot_sim.parameters import Spec, parameter, specs, suggestion
from diffbot_sim.physics import Friction, Robot

LENGTH = Spec('length', 1.0, 'm', 'length of the rod', low=0.5, high=2.0)
COLOUR = Spec('colour', 'red', '', 'colour of the rod', choices=('red', 'blue'))


@dataclass(frozen=True)
class Rod:
    label: str = 'no parameter'
    length: float = parameter(1.0, unit='m', low=0.5, high=2.0, meaning='length of the rod')
    colour: str = parameter('red', choices=('red', 'blue'), meaning='colour of the rod')


def test_specs_come_from_the_fields_in_their_order():
    assert specs(Rod) == (LENGTH, COLOUR)
    assert specs(Rod(length=2.0)) == specs(Rod)


@given(value=st.floats(0.5, 2.0) | st.integers(1, 2))
def test_value_within_bounds_has_no_fault(value):
    assert LENGTH.fault(value) is None


@pytest.mark.parametrize('value', [0.499, 2.001, nan, inf, -inf, True, '1.0', None, [1.0]])
def test_anything_else_is_refused_with_the_valid_values(value):
    fault = LENGTH.fault(value)
    assert fault == f'{value!r} is not valid; length (length of the rod) takes 0.5 to 2 m'


def test_choice_is_one_of_the_list():
    assert COLOUR.fault('blue') is None
    assert COLOUR.fault('green') == (
        "'green' is not valid; colour (colour of the rod) takes one of red, blue"
    )


def test_suggestion_names_the_nearest_known_word():
    assert suggestion('viscos', ['coulomb', 'viscous']) == (
        "Known: coulomb, viscous. Did you mean 'viscous'?"
    )
    assert suggestion('zzz', ['coulomb']) == 'Known: coulomb.'


@pytest.mark.parametrize('spec', [*specs(Robot), *specs(Friction)], ids=lambda spec: spec.name)
def test_parameters_of_the_nominal_model_are_bounded_and_explained(spec):
    assert spec.meaning
    assert spec.fault(spec.default) is None
    assert spec.choices or (spec.unit and isfinite(spec.low) and isfinite(spec.high))
    assert spec.scale > 0.0
