"""Parts of the floor."""

from dataclasses import replace

import numpy as np
from rehearsal import Surroundings, random_forces, rehearse

from diffbot_sim.identification.free_forms.floor import by_place, in_time
from diffbot_sim.identification.recordings.stretches import whole
from diffbot_sim.physics import Model

(STRETCH,) = whole([rehearse(Model(), random_forces(2, 60.0, -9.0, 11.0), Surroundings(), 2)])


def test_order_along_the_floor_has_every_used_sample_once() -> None:
    np.testing.assert_array_equal(np.sort(by_place([STRETCH])), in_time([STRETCH]))


def test_parts_of_the_floor_are_small() -> None:
    places = STRETCH.pose[STRETCH.used][by_place([STRETCH])][:, :2]
    parts = np.array_split(places, 24)
    spread = np.mean([part.std(axis=0).prod() for part in parts])
    assert spread < places.std(axis=0).prod() / 10.0


def test_runs_without_a_pose_lie_in_one_place() -> None:
    blind = replace(STRETCH, pose=None)
    np.testing.assert_array_equal(np.sort(by_place([blind, STRETCH])), in_time([blind, STRETCH]))
