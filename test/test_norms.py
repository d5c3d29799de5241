"""The noise floor: what a perfect model leaves of what was measured."""

import numpy as np
import pytest

from diffbot_sim.identification.statistics.norms import noise_floor, resolution

TIME = np.arange(5000) / 50.0
TRUE = np.column_stack([np.sin(0.5 * TIME), 2.0 * np.cos(0.3 * TIME)])


def test_floor_of_white_noise_is_its_deviation() -> None:
    noise = np.random.default_rng(1).normal(size=TRUE.shape) * [0.004, 0.008]
    floor = noise_floor([TRUE + noise], [TRUE])
    assert (floor.v_rmse, floor.omega_rmse) == pytest.approx((0.004, 0.008), rel=0.05)


def test_error_of_a_model_that_is_slowly_wrong_is_no_noise() -> None:
    floor = noise_floor([TRUE], [1.2 * TRUE])
    assert max(floor.v_rmse, floor.omega_rmse) < 1e-3


@pytest.mark.parametrize('step', [0.001, 0.03])
def test_floor_of_a_coarse_encoder_is_the_error_of_its_steps(step: float) -> None:
    told = np.round(TRUE / step) * step
    floor = noise_floor([told], [TRUE])
    error = np.sqrt(np.mean((told - TRUE) ** 2, axis=0))
    assert (floor.v_rmse, floor.omega_rmse) == pytest.approx(error, rel=0.1)


def test_floor_of_a_robot_that_mostly_rests_is_that_of_its_moving() -> None:
    moves = (np.arange(len(TIME)) < 0.3 * len(TIME))[:, None]
    noise = np.random.default_rng(2).normal(size=TRUE.shape) * [0.004, 0.008] * moves
    floor = noise_floor([TRUE * moves + noise], [TRUE * moves])
    error = np.sqrt(np.mean(noise**2, axis=0))
    assert (floor.v_rmse, floor.omega_rmse) == pytest.approx(error, rel=0.1)


def test_outliers_do_not_raise_the_floor() -> None:
    noise = np.random.default_rng(3).normal(size=TRUE.shape) * 0.004
    noise[::100] += 0.5
    floor = noise_floor([TRUE + noise], [TRUE])
    assert floor.v_rmse == pytest.approx(0.004, rel=0.05)


def test_what_stands_still_has_no_resolution() -> None:
    np.testing.assert_array_equal(resolution(np.zeros((100, 2))), 0.0)
