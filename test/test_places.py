"""A force that belongs to places, as on a hilly floor: no effect has it, a free form sees it."""

from dataclasses import dataclass
from math import cos, sin

from diffbot_sim.control.rehearsal import Surroundings, random_forces, rehearse
from diffbot_sim.identification import identify
from diffbot_sim.parameters import parameter
from diffbot_sim.physics import Model
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.effects import Effect
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


def test_hills_are_unexplained_and_known_by_where_they_are() -> None:
    drive = random_forces(4, 90.0, -9.0, 11.0)
    result = identify([rehearse(Model(effects=(Hills(1.5),)), drive, Surroundings(), 4)], Model())
    assert result.effects == ()
    assert result.unexplained is not None
    assert (result.unexplained.axis, result.unexplained.variable) == ('v', 'hill_x')
