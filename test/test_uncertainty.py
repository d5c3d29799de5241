"""Estimates: values, intervals, and whether a bound stopped the fit."""

import numpy as np
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.identification.conclusions.uncertainty import (
    CHANCE,
    estimates,
    estimates_at,
    farthest,
)
from diffbot_sim.identification.fitting.coordinates import Space, point_of
from diffbot_sim.identification.fitting.fit import fit_simulation
from diffbot_sim.identification.recordings.stretches import whole
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects.payload_change import PayloadChange
from diffbot_sim.physics.effects.power_limit import PowerLimit
from diffbot_sim.records import Commands

SPACE = Space(Model(), ())
NAMES = [coordinate.name for coordinate in SPACE.coordinates]


def test_parameter_that_a_bound_stopped_is_marked_and_no_other() -> None:
    u = SPACE.prior()
    u[NAMES.index('mu_viscous')] = 1e-5
    found = estimates_at(SPACE, u, 1e-4 * np.eye(len(u)))
    assert [name for name, estimate in found.items() if estimate.at_bound] == ['mu_viscous']


def test_interval_of_a_mass_follows_from_its_logarithm() -> None:
    mass = estimates_at(SPACE, SPACE.prior(), 1e-4 * np.eye(len(NAMES)))['mass']
    np.testing.assert_allclose(mass.high - mass.value, 10.0 * 0.01 * 2.02, rtol=0.01)


def test_limit_that_does_not_show_is_known_from_below() -> None:
    space = Space(Model(), (PowerLimit,))
    power = estimates_at(space, space.prior(), 1e-4 * np.eye(len(NAMES) + 2))['power_limit.power']
    np.testing.assert_allclose(power.low, 10.0 / (0.01 * 2.02), rtol=0.01)
    assert power.high == 1e9


def test_interval_reaches_across_a_hollow_of_the_likelihood() -> None:
    def rise(value: float) -> float:
        return {True: 2.0 * CHANCE, False: 0.0}[0.3 < value < 1.0] + 100.0 * (value > 2.0)

    np.testing.assert_allclose(farthest(rise, 0.0, 50.0), 2.0, rtol=0.02)


def test_interval_ends_at_a_bound_where_nothing_speaks_against_it() -> None:
    assert farthest(lambda value: 0.0, 1.0, -3.0) == -3.0


def test_load_of_a_heavy_robot_is_not_pulled_to_none() -> None:
    space = Space(Model(), (PayloadChange,))
    own = [space.coordinates[index] for index in space.places('payload_change')]
    mass = next(coordinate for coordinate in own if coordinate.name.endswith('mass'))
    assert (9.0 / mass.value(1.0) / mass.deviation) ** 2 < 0.1  # of one sample's worth


def test_what_a_straight_drive_does_not_show_has_a_wide_interval() -> None:
    given = random_forces(1, 20.0, -9.0, 11.0)
    straight = Commands(given.time, given.force[:, [0, 0]])
    run = rehearse(Model(), straight, Surroundings(omega_noise=0.0), 1)
    found = estimates(fit_simulation(SPACE, whole([run]), SPACE.prior()))
    assert found['mass'].high - found['mass'].low < 0.1 * found['mass'].value
    assert found['inertia'].high > 2.0 * found['inertia'].value
    assert found['inertia'].low >= 0.0


def test_moment_that_was_fitted_by_simulation_is_known() -> None:
    loaded = Model(effects=(PayloadChange(4.0, 0.2, 20.0, 0.0),))
    run = rehearse(loaded, random_forces(1, 40.0, -9.0, 11.0), Surroundings(roughness=0.5), 1)
    space = Space(Model(), (PayloadChange,))
    start = np.append(SPACE.prior(), point_of(PayloadChange, (4.0, 0.2, 20.0, 0.0)))
    moment = estimates(fit_simulation(space, whole([run]), start))['payload_change.moment']
    assert moment.low < 20.0 < moment.high
    assert moment.high - moment.low < 10.0
