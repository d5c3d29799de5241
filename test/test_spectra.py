"""Spectra of the force that is still missing."""

import numpy as np

from diffbot_sim.report.spectra import density

TIME = np.arange(0.0, 60.0, 0.02)


def test_rhythm_is_a_peak_at_its_frequency() -> None:
    frequency, size = density(TIME, np.sin(2.0 * np.pi * 1.5 * TIME))
    assert abs(frequency[np.argmax(size)] - 1.5) < 0.1


def test_white_noise_is_flat_at_its_density() -> None:
    _, size = density(TIME, np.random.default_rng(0).normal(size=len(TIME)))
    np.testing.assert_allclose(np.sqrt(np.mean(size**2)), np.sqrt(2.0 * 0.02), rtol=0.1)


def test_rest_adds_nothing_to_the_way() -> None:
    way = np.concatenate([np.zeros(500), 0.01 * np.arange(2000)])
    frequency, size = density(way, np.sin(2.0 * np.pi * 3.0 * way))
    assert abs(frequency[np.argmax(size)] - 3.0) < 0.3


def test_short_run_has_no_spectrum() -> None:
    frequency, size = density(TIME[:20], np.zeros(20))
    assert len(frequency) == len(size) == 0
