"""Real data: a skid-steer drive, quasi-static."""

import os
from pathlib import Path

import pytest
from warthog import POINTS, explained, left_out, read_points

from diffbot_sim.physics.effects.com_offset import ComOffset
from diffbot_sim.physics.effects.yaw_friction import YawFriction

ROOT = Path(__file__).parents[1]
DATA = Path(os.environ.get('DIFFBOT_DATA', ROOT.parent / 'shared' / 'data')) / 'warthog-drive'

needs_data = pytest.mark.skipif(
    not (DATA / POINTS).exists(),
    reason='no Warthog data: see benchmarks/README.md and set DIFFBOT_DATA to their folder',
)


@needs_data
def test_yaw_friction_explains_logs_that_it_was_not_fitted_to() -> None:
    grass = read_points(DATA / POINTS)['grass']
    sparse = grass.of(slice(None, None, 6))
    shares = [explained(left_out(kind, sparse), sparse) for kind in (None, ComOffset, YawFriction)]
    assert shares[0] < 0.3 < 0.8 < shares[2]
    assert shares[1] < 0.6
