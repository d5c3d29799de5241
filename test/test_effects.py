"""What every effect promises, found by walking the library."""

import subprocess
import sys
from dataclasses import dataclass, fields
from math import isfinite

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from motion import (
    drive,
    drives,
    kinetic_energy,
    models,
    numbers,
    push,
    robots,
    starts,
    table,
    traction_work,
)

from diffbot_sim.parameters import Spec, parameter
from diffbot_sim.physics import Friction, Model, effects
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.effects import Effect, Excitation, library
from diffbot_sim.physics.effects.actuator_lag import ActuatorLag
from diffbot_sim.physics.effects.com_offset import ComOffset
from diffbot_sim.physics.effects.quadratic_drag import QuadraticDrag
from diffbot_sim.physics.effects.slope import Slope
from diffbot_sim.physics.stages import Load, Motion, Stage, pushed

KINDS = list(library().values())
SMOOTH = Friction('none')
each_effect = pytest.mark.parametrize('kind', KINDS, ids=lambda kind: kind.name)


def within_reach(kind: type[Effect]) -> st.SearchStrategy[Effect]:
    """Draw parameters within their bounds, at most ten typical departures from neutral."""
    return st.builds(kind, **{spec.name: reach_of(spec) for spec in kind.specs()})


def reach_of(spec: Spec) -> st.SearchStrategy[float]:
    if spec.choices:
        return st.sampled_from(spec.choices)
    if spec.reciprocal:
        return st.floats(0.01 * spec.scale, 10.0 * spec.scale)
    low, high = spec.default - 10.0 * spec.scale, spec.default + 10.0 * spec.scale
    return numbers(max(spec.low, low), min(spec.high, high))


@each_effect
def test_effect_tells_people_what_it_is(kind):
    for words in (kind.name, kind.meaning, kind.source, kind.excitation):
        assert words.strip()
    assert kind.name.isidentifier()
    assert kind.__doc__


@each_effect
def test_every_field_of_an_effect_is_a_bounded_parameter(kind):
    names = [spec.name for spec in kind.specs()]
    assert names == [field.name for field in fields(kind)]
    for spec in kind.specs():
        assert spec.meaning
        if spec.choices:
            continue
        assert spec.unit
        assert isfinite(spec.low)
        assert isfinite(spec.high)
        assert 0.0 < spec.scale <= spec.high - spec.low
        assert spec.fault(spec.default) is None


@each_effect
def test_fits_start_within_bounds_and_away_from_neutral(kind):
    assert kind.guesses
    for guess in kind.guesses:
        assert kind(*guess) != kind()
        for spec, value in zip(kind.specs(), guess, strict=True):
            assert spec.fault(value) is None


@each_effect
def test_starts_for_any_drive_lie_within_bounds(kind):
    small, large = (5.0, 60.0), (300.0, 2e3, (3.0, 7.5))
    for offered in (Excitation(*small), Excitation(*large)):
        starts = kind.starts(offered)
        assert starts
        for start in starts:
            faults = [s.fault(x) for s, x in zip(kind.specs(), start, strict=True)]
            assert not any(faults)


@each_effect
def test_shape_is_made_of_parameters_and_leaves_some_out(kind):
    assert set(kind.shape) < {spec.name for spec in kind.specs()}


@each_effect
@given(model=models(), rows=drives(20.0), start=starts())
def test_neutral_effect_changes_no_bit(kind, model, rows, start):
    without = drive(model, *rows, until=2.5, start=start)
    neutral = drive(model.with_effect(kind()), *rows, until=2.5, start=start)
    np.testing.assert_array_equal(table(neutral), table(without))


@given(model=models(), rows=drives(20.0), start=starts())
def test_all_effects_together_change_no_bit_when_neutral(model, rows, start):
    without = drive(model, *rows, until=2.5, start=start)
    everything = Model(model.robot, model.friction, tuple(kind() for kind in KINDS))
    neutral = drive(everything, *rows, until=2.5, start=start)
    np.testing.assert_array_equal(table(neutral), table(without))


@each_effect
@given(data=st.data(), rows=drives(20.0), start=starts())
def test_effect_gives_finite_output(kind, data, rows, start):
    model = Model(effects=(data.draw(within_reach(kind)),))
    assert np.isfinite(table(drive(model, *rows, until=2.5, start=start))).all()


@pytest.mark.parametrize('kind', [kind for kind in KINDS if kind.dissipative])
@given(data=st.data(), robot=robots(), rows=drives(20.0), start=starts())
def test_dissipative_effect_never_adds_energy(kind, data, robot, rows, start):
    model = Model(robot, SMOOTH, (data.draw(within_reach(kind)),))
    run = drive(model, *rows, until=2.5, every=0.25 / 8, start=start)
    energy, work = kinetic_energy(robot, run), traction_work(robot, run)
    # A stop is located to 1e-11 of a step, so it leaves a speed of 1e-13 m/s or so.
    turnover = energy.max() + np.abs(np.diff(work)).sum() + 1e-19
    assert (np.diff(work) - np.diff(energy)).min() >= -1e-5 * turnover


@each_effect
@given(guess=st.integers(0, 9), rows=drives(20.0))
def test_stamps_change_the_motion_by_no_more_than_the_integration_error(kind, guess, rows):
    """Stamps cut steps; they do nothing else."""
    model = Model(effects=(kind(*kind.guesses[guess % len(kind.guesses)]),))
    coarse = drive(model, *rows, until=2.5, every=0.25)
    fine = drive(model, *rows, until=2.5, every=0.25 / 64)
    np.testing.assert_allclose(fine.pose[::64], coarse.pose, rtol=1e-5, atol=1e-6)


def test_library_lists_effects_in_order_of_evaluation():
    places = [(kind.stage, kind.name) for kind in KINDS]
    assert places == sorted(places)
    assert list(library()) == [kind.name for kind in KINDS]


@given(order=st.permutations([ActuatorLag(0.1), QuadraticDrag(2.0), Slope(0.01), ComOffset(0.1)]))
def test_order_in_which_effects_are_given_does_not_matter(order):
    assert Model(effects=tuple(order)) == Model(effects=tuple(reversed(order)))


@compiled
def wind(at: Motion, load: Load, force: float) -> Load:
    """Push forward."""
    return pushed(load, force, 0.0)


@dataclass(frozen=True)
class Tailwind(Effect):
    """Constant force from behind."""

    name = 'tailwind'
    meaning = 'wind from behind'
    source = 'a package of its own'
    stage = Stage.BODY_LOAD
    kernel = wind
    guesses = ((1.0,),)
    excitation = 'any'

    force: float = parameter(0.0, unit='N', low=0.0, high=10.0, meaning='force of the wind')


class TailwindEntry:
    """What a package that brings the effect declares."""

    @staticmethod
    def load() -> type[Effect]:
        return Tailwind


def test_another_package_can_bring_an_effect(monkeypatch):
    monkeypatch.setattr(effects, 'entry_points', lambda group: [TailwindEntry])
    found = library.__wrapped__()
    assert found['tailwind'] is Tailwind
    assert set(found) == {*library(), 'tailwind'}
    run = push(Model(friction=SMOOTH, effects=(Tailwind(5.0),)), 0.0, 0.0, 1.0)
    assert run.twist[-1, 0] == pytest.approx(5.0 / 10.0)


GUST = """
from diffbot_sim.physics import Model
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.composition import compose
from diffbot_sim.physics.effects.quadratic_drag import QuadraticDrag
from diffbot_sim.physics.stages import pushed

@compiled
def gust(at, load, coefficient):
    return pushed(load, coefficient, 0.0)

class Gust(QuadraticDrag):
    kernel = gust

compose((Gust,))
"""


def test_effect_whose_module_got_another_name_compiles_again(tmp_path):
    for name in ('before', 'after'):
        file = tmp_path / f'{name}.py'
        file.write_text(GUST)
        subprocess.run([sys.executable, '-c', f'import {name}'], cwd=tmp_path, check=True)
        file.unlink()
