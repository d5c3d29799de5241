"""Where on the floor a patch is that is unlike the rest."""

from itertools import combinations
from types import SimpleNamespace

import numpy as np
import pytest

from diffbot_sim.identification.free_forms.patch import Patch, wheel_places

HALF = 0.2
MIX = np.array([[1.0, 1.0], [HALF, -HALF]])


def driven(pose: np.ndarray | None, error: np.ndarray) -> SimpleNamespace:
    """Return a view of wheels that err by as much, shape (k, 2)."""
    stretch = SimpleNamespace(pose=pose, time=np.arange(len(error)))
    fit = SimpleNamespace(model=SimpleNamespace(half_separation=HALF))
    return SimpleNamespace(
        stretch=stretch, fit=fit, mix=MIX, innovation=error @ np.linalg.inv(MIX)
    )


def wandering(seed: int = 0) -> np.ndarray:
    return np.random.default_rng(seed).uniform([-3.0, -2.0, -9.0], [3.0, 2.0, 9.0], (6000, 3))


def within(view: SimpleNamespace, middle: tuple[float, float], radius: float) -> np.ndarray:
    return np.linalg.norm(wheel_places(view) - middle, axis=2) < radius


@pytest.mark.parametrize('radius', [0.4, 1.0])
def test_patch_is_found_where_it_is_felt(radius: float) -> None:
    pose = wandering()
    noise = np.random.default_rng(1).normal(size=(len(pose), 2))
    felt = within(driven(pose, noise), (1.2, -0.5), radius)
    patch, *_ = Patch(lambda view: -np.ones(1)).grids([driven(pose, noise - 2.0 * felt)])
    np.testing.assert_allclose(patch, [1.2, -0.5, radius], atol=0.3 * radius)


def test_patches_that_are_tried_lie_beside_each_other() -> None:
    error = np.random.default_rng(2).normal(size=(6000, 2))
    patches = Patch(lambda view: np.ones(1)).grids([driven(wandering(), error)])
    assert len(patches) > 1
    for one, other in combinations(patches, 2):
        assert np.linalg.norm(one[:2] - other[:2]) >= max(one[2], other[2])


def test_no_patch_is_tried_where_no_pose_is_known_or_the_robot_stays() -> None:
    form, error = Patch(lambda view: np.ones(1)), np.ones((100, 2))
    assert form.grids([driven(None, error)]) == []
    assert not form.columns(driven(None, error), np.array([0.0, 0.0, 1.0])).any()
    still = driven(np.zeros((100, 3)), error)
    assert all(form.columns(still, patch).any() for patch in form.grids([still]))


def test_wheels_stand_aside_of_the_robot() -> None:
    pose = np.array([[1.0, 2.0, 0.0], [1.0, 2.0, np.pi / 2]])
    right, left = wheel_places(driven(pose, np.ones((2, 2)))).swapaxes(0, 1)
    np.testing.assert_allclose(right, [[1.0, 2.0 - HALF], [1.0 + HALF, 2.0]])
    np.testing.assert_allclose(left, [[1.0, 2.0 + HALF], [1.0 - HALF, 2.0]])


def test_patch_pushes_only_the_wheel_that_is_on_it() -> None:
    pose = np.array([[0.0, HALF, 0.0]])
    column = Patch(lambda view: view.push).columns(
        SimpleNamespace(**vars(driven(pose, np.ones((1, 2)))), push=np.array([[-3.0, -4.0]])),
        np.array([0.0, 0.0, HALF]),
    )
    np.testing.assert_array_equal(column, [[[-3.0, 0.0]]])
