"""A load that presses on the wheels, and a floor that only looks like one."""

import pytest
from peer_drives import DRIVES
from peer_recording import Recording, record
from peer_robots import MAKES, exact

from diffbot_sim.identification import Identification, identify
from diffbot_sim.physics.effects.payload_change import PayloadChange

DURATION = 40.0


def answer(duration: float = DURATION, **changed: float) -> Identification:
    """Return what is said of a robot of other make by a search that knows of loads alone."""
    make = MAKES['medium']
    driver = DRIVES['forces'](make, 3, duration, 50.0)
    how = Recording(duration=duration)
    run = record(make.plant._replace(**changed), driver, how, 3)
    return identify([run], exact(make.plant), kinds=[PayloadChange])


def test_load_is_named_with_the_friction_that_it_causes() -> None:
    load = {'load_mass': 2.0, 'load_inertia': 0.08, 'load_time': 15.0}
    share = 2.0 / MAKES['medium'].plant.mass
    (found,) = answer(**load, load_friction=share).effects
    assert found.parameters['mass'].value == pytest.approx(2.0, rel=0.05)
    assert found.parameters['friction_share'].value == pytest.approx(1.0, abs=0.1)


def test_load_is_named_that_is_put_on_after_the_part_that_is_fitted_at_first() -> None:
    (found,) = answer(60.0, load_mass=2.0, load_inertia=0.08, load_time=45.0).effects
    assert found.parameters['mass'].value == pytest.approx(2.0, rel=0.1)


def test_floor_that_changes_is_no_load() -> None:
    result = answer(carpet=0.3, carpet_time=15.0)
    assert (result.verdict, result.effects) == ('unexplained', ())
