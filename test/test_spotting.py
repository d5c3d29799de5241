"""Where on the floor a patch or a hill is that is unlike the rest."""

from itertools import combinations
from types import SimpleNamespace

import numpy as np
import pytest

from diffbot_sim.identification.free_forms.patch import Patch
from diffbot_sim.identification.free_forms.round_hill import RoundHill
from diffbot_sim.identification.free_forms.spotting import wheel_places
from diffbot_sim.records import Array

HALF, COUNT = 0.2, 6000
MIX = np.array([[1.0, 1.0], [HALF, -HALF]])
ALIKE = Patch(lambda view: np.ones((len(view.stretch.time), 2)))


def driven(pose: Array | None, errors: Array) -> SimpleNamespace:
    """Return a view of wheels that err by so much, shape (k, 2)."""
    heading = np.zeros(len(errors)) if pose is None else pose[:, 2]
    stretch = SimpleNamespace(pose=pose, heading=heading, time=np.arange(len(errors)))
    fit = SimpleNamespace(model=SimpleNamespace(half_separation=HALF))
    innovation = errors @ np.linalg.inv(MIX)
    return SimpleNamespace(stretch=stretch, fit=fit, mix=MIX, innovation=innovation)


def wandering() -> Array:
    return np.random.default_rng(0).uniform([-3.0, -2.0, -9.0], [3.0, 2.0, 9.0], (COUNT, 3))


def noise() -> Array:
    return np.random.default_rng(1).normal(size=(COUNT, 2))


@pytest.mark.parametrize('form', [ALIKE, RoundHill()], ids=['patch', 'hill'])
@pytest.mark.parametrize('spot', [(1.2, -0.5, 0.5), (-0.4, 0.6, 1.0)])
def test_spot_is_found_where_it_is_felt(form: Patch | RoundHill, spot: tuple[float, ...]) -> None:
    view = driven(wandering(), noise())
    felt = driven(wandering(), noise() - 3.0 * form.columns(view, np.array(spot))[:, 0])
    first, *_ = form.grids([felt])
    np.testing.assert_allclose(first, spot, atol=0.35 * spot[2])


@pytest.mark.parametrize('form', [ALIKE, RoundHill()], ids=['patch', 'hill'])
def test_no_spot_that_is_tried_has_the_middle_of_another_in_it(form: Patch | RoundHill) -> None:
    spots = form.grids([driven(wandering(), noise())])
    assert len(spots) > 1
    for one, other in combinations(spots, 2):
        assert np.linalg.norm(one[:2] - other[:2]) >= 0.95 * max(one[2], other[2])


@pytest.mark.parametrize('form', [ALIKE, RoundHill()], ids=['patch', 'hill'])
def test_where_no_pose_is_known_nothing_is_felt(form: Patch | RoundHill) -> None:
    blind = driven(None, noise())
    assert form.grids([blind]) == []
    assert not form.columns(blind, np.array([0.0, 0.0, 1.0])).any()


@pytest.mark.parametrize('form', [ALIKE, RoundHill()], ids=['patch', 'hill'])
def test_what_a_robot_feels_that_stays_where_it_is_is_a_number(form: Patch | RoundHill) -> None:
    still = driven(np.zeros((COUNT, 3)), noise())
    spots = form.grids([still])
    assert spots
    assert np.all(np.isfinite([form.columns(still, spot) for spot in spots]))


def test_wheels_stand_aside_of_the_robot() -> None:
    pose = np.array([[1.0, 2.0, 0.0], [1.0, 2.0, np.pi / 2]])
    right, left = wheel_places(driven(pose, np.ones((2, 2)))).swapaxes(0, 1)
    np.testing.assert_allclose(right, [[1.0, 2.0 - HALF], [1.0 + HALF, 2.0]])
    np.testing.assert_allclose(left, [[1.0, 2.0 + HALF], [1.0 - HALF, 2.0]])


def test_patch_acts_only_on_the_wheel_that_is_on_it() -> None:
    view = driven(np.array([[0.0, HALF, 0.0]]), np.ones((1, 2)))
    np.testing.assert_array_equal(ALIKE.columns(view, np.array([0.0, 0.0, HALF])), [[[1.0, 0.0]]])


def test_hill_pushes_down_its_side_whichever_way_the_robot_faces() -> None:
    pose = np.array([[0.5, 0.0, 0.0], [0.5, 0.0, np.pi], [0.5, 0.0, np.pi / 2]])
    push = RoundHill().columns(driven(pose, np.ones((3, 2))), np.array([0.0, 0.0, 1.0]))[:, 0]
    assert np.all(push[0] > 0.0)
    np.testing.assert_allclose(push[1], -push[0, ::-1])
    np.testing.assert_allclose(push[2], 0.0, atol=1e-12)
