"""The past of commands: any law by which a wheel's force follows them late, or not at once."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar

import numpy as np

from diffbot_sim.identification.fitting.views import View
from diffbot_sim.records import Array

# Edges of the spans in which the past of a command is averaged [s].
PAST = np.array([0.0, 0.02, 0.05, 0.1, 0.2, 0.4, 0.8])


@dataclass(frozen=True)
class Past:
    """Every wheel's command in spans of the past: any linear law between command and force."""

    looked_at: ClassVar[int] = 1

    def grids(self, views: Sequence[View]) -> list[Array]:
        """Return the edges of the spans [s]."""
        del views
        return [PAST]

    def columns(self, view: View, edges: Array) -> Array:
        """Return mean commands of each span, over the largest command."""
        spans = [view.past_force(*span) for span in pairwise(edges)]
        return np.stack(spans, axis=1) / view.largest_force

    def curve(self, edges: Array) -> tuple[Array, Array]:
        """Return the middles of the spans and the functions there."""
        return 0.5 * (edges[1:] + edges[:-1]), np.eye(len(edges) - 1)


@dataclass(frozen=True)
class Changes(Past):
    """How far every wheel's command is from its past, squared, with its sign.

    Any law by which large changes act otherwise than small ones.
    """

    def columns(self, view: View, edges: Array) -> Array:
        """Return signed squares of changes since each span, over the largest command."""
        now = view.force[:, None] / view.largest_force
        changes = now - super().columns(view, edges)
        return np.asarray(changes * np.abs(changes))
