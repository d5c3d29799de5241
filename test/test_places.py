"""A force that belongs to the world, of hills or wind: no effect has it, a free form sees it."""

from dataclasses import dataclass
from math import cos, sin

import pytest
from fits import left_by
from peer_drives import DRIVES
from peer_recording import Recording, record
from peer_robots import MAKES, exact
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.identification import identify
from diffbot_sim.identification.free_forms.dependence import Dependence
from diffbot_sim.parameters import parameter
from diffbot_sim.physics import Model
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.effects import Effect
from diffbot_sim.physics.effects.slope import Slope
from diffbot_sim.physics.stages import Load, Motion, Stage, pushed


@compiled
def downhill(at: Motion, load: Load, pull: float) -> Load:
    """Pull towards the valleys of a floor with a wave every 3 m along x."""
    return pushed(load, -pull * sin(2.1 * at.x) * cos(at.heading), 0.0)


@dataclass(frozen=True)
class Hills(Effect):
    """A floor like corrugated iron."""

    name = 'hills'
    meaning = 'hills and valleys along x'
    source = 'this test'
    stage = Stage.BODY_LOAD
    kernel = downhill
    guesses = ((1.0,),)
    excitation = 'driving about'

    pull: float = parameter(0.0, unit='N', low=-1e3, high=1e3, meaning='steepest pull')


def left_by_what_pulls(**pulls: float) -> list[Dependence]:
    """Return what the model that would be true without them leaves unexplained."""
    make, how = MAKES['medium'], Recording()
    drive = DRIVES['forces'](make, 0, how.duration, how.rate)
    return left_by(record(make.plant._replace(**pulls), drive, how, 0), exact(make.plant))


def test_hills_are_unexplained_and_known_by_where_they_are() -> None:
    drive = random_forces(4, 90.0, -9.0, 11.0)
    result = identify([rehearse(Model(effects=(Hills(1.5),)), drive, Surroundings(), 4)], Model())
    assert result.effects == ()
    assert result.unexplained is not None
    assert (result.unexplained.axis, result.unexplained.variable) == ('v', 'hill_x')


@pytest.mark.parametrize(
    ('wind', 'grade', 'names'), [(1.5, 0.0, []), (0.3, 0.03, ['slope'])], ids=['wind', 'slope']
)
def test_pull_that_changes_is_no_slope(wind: float, grade: float, names: list[str]) -> None:
    make, how = MAKES['medium'], Recording(duration=60.0)
    blown = make.plant._replace(wind=wind, wind_turn=-0.02, rise_x=grade)
    drive = DRIVES['forces'](make, 0, how.duration, how.rate)
    result = identify([record(blown, drive, how, 0)], exact(make.plant), kinds=[Slope])
    assert [effect.name for effect in result.effects] == names
    assert result.unexplained is not None
    assert result.unexplained.variable == 'pull'


def test_ground_in_short_waves_is_known_by_where_they_are() -> None:
    left, *_ = left_by_what_pulls(wave=0.03, wave_length=1.3)
    assert (left.basis.axis, left.basis.variable) == ('v', 'hill_x')


def test_wind_that_veers_is_told_as_a_pull_that_changes() -> None:
    variables = {left.basis.variable for left in left_by_what_pulls(wind=1.5, wind_turn=-0.05)}
    assert 'pull' in variables
