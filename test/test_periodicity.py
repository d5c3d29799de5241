"""At which orders errors repeat."""

import numpy as np
import pytest

from diffbot_sim.identification.fitting.periodicity import _power, _strongest

BAND, SPACING = (0.2, 6.0), 0.004
ORDERS = np.arange(*BAND, SPACING)


def turned(seed: int):
    """Return angles of two wheels that go to and fro, and noise."""
    generator = np.random.default_rng(seed)
    return np.cumsum(generator.normal(0.1, 0.3, (3000, 2)), axis=0), generator.normal(
        size=(3000, 2)
    )


@pytest.mark.parametrize('seed', range(3))
def test_power_is_that_of_the_waves_summed_one_by_one(seed) -> None:
    angles, errors = turned(seed)
    waves = np.exp(1j * ORDERS[:, None, None] * angles)
    wanted = np.sum(np.abs(np.sum(errors * waves, axis=1)) ** 2, axis=1)
    assert _power(ORDERS, angles, errors) == pytest.approx(wanted, abs=0.01 * wanted.max())


@pytest.mark.parametrize('order', [0.73, 2.0, 5.417])
def test_strongest_order_is_that_of_the_wave_in_the_errors(order) -> None:
    angles, errors = turned(1)
    found = _strongest(BAND, SPACING, angles, errors + 0.3 * np.sin(order * angles + 1.0))
    assert found[0] == pytest.approx(order, abs=0.002)


def test_weaker_wave_is_found_beside_a_stronger_one() -> None:
    angles, errors = turned(2)
    waves = np.sin(2.0 * angles) + 0.3 * np.cos(3.3 * angles)
    found = _strongest(BAND, SPACING, angles, errors + waves)
    assert found[:2] == pytest.approx([2.0, 3.3], abs=0.002)


@pytest.mark.parametrize('seed', range(5))
def test_what_depends_on_the_angle_anyhow_has_no_order(seed) -> None:
    angles, errors = turned(seed)
    floor = np.cumsum(np.random.default_rng(seed).normal(size=2000))
    floor -= np.convolve(floor, np.ones(40) / 40, 'same')
    errors += 0.3 * np.interp(angles, np.linspace(angles.min(), angles.max(), 2000), floor)
    assert _strongest(BAND, SPACING, angles, errors) == ()


def test_short_pushes_are_found_by_their_harmonics() -> None:
    angles, errors = turned(3)
    errors[angles % (2.0 * np.pi / 0.8) < 0.4] += 1.5
    first, *_ = _strongest(BAND, SPACING, angles, errors, teeth=4)
    assert first == pytest.approx(0.8, abs=0.0005)


@pytest.mark.parametrize('seed', range(20))
@pytest.mark.parametrize('teeth', [1, 4])
def test_noise_has_no_order(seed: int, teeth: int) -> None:
    angles, errors = turned(seed)
    assert _strongest(BAND, SPACING, angles, errors, teeth) == ()
