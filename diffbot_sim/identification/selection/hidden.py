"""Effects that hide each other: one undoes what the other does, or what calibration makes of it.

A search that adds one effect at a time sees neither of them.
"""

from collections.abc import Mapping, Sequence
from itertools import combinations
from typing import NamedTuple

import numpy as np

from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.selection.candidates import approach
from diffbot_sim.identification.selection.screening import Score, Screen
from diffbot_sim.identification.statistics.guards import chance_of_fall, may_be_chance
from diffbot_sim.physics.effects import Effect
from diffbot_sim.records import Array

# So many of the pairs that promise most are fitted for a short while.
MOST_FITTED = 3


class _Pair(NamedTuple):
    """Two effects, the one that explains more by itself first, and what both are worth in BIC."""

    kinds: tuple[type[Effect], type[Effect]]
    worth: float


def hidden(screen: Screen, kinds: Sequence[type[Effect]]) -> list[Fit]:
    """Return approached fits of effects beside which another one should enter, likeliest first.

    Each effect is one of two that together explain, to first order, what chance would not, of
    which either is worth its price beside the other, and that are worth theirs when a few steps
    have been made. screen: of a structure that none of the kinds enters by itself.
    """
    scores = {kind: screen.score(kind) for kind in kinds if kind not in screen.fit.space.kinds}
    seen = [kind for kind, score in scores.items() if score.seen]
    pairs = _Pairs(screen, {kind: scores[kind] for kind in seen})
    found = [pair for two in combinations(seen, 2) if (pair := pairs.of(*two)) is not None]
    promising = sorted(found, key=lambda pair: -pair.worth)[:MOST_FITTED]
    leading = dict.fromkeys(pair.kinds[0] for pair in promising)
    near = {kind: Screen(approach(screen, kind)) for kind in leading}
    kept = [pair for pair in promising if _is_worth_its_price(screen, near, pair)]
    return [near[kind].fit for kind in dict.fromkeys(pair.kinds[0] for pair in kept)]


def _is_worth_its_price(screen: Screen, near: Mapping[type[Effect], Screen], pair: _Pair) -> bool:
    """Say whether two effects lower the BIC by a few steps: first order promises much.

    near: screens of the fits that approached the first one of each pair.
    """
    base, (first, second) = screen.fit, pair.kinds
    both = approach(near[first], second)
    fall = base.deviance(base.sigma) - both.deviance(base.sigma)
    return fall > screen.price(first) + screen.price(second)


class _Pairs:
    """What effects explain together, to first order."""

    def __init__(self, screen: Screen, scores: dict[type[Effect], Score]) -> None:
        self._screen, self._scores = screen, scores
        self._tried = len(scores) * (len(scores) - 1) // 2
        columns, self._places = list[Array](), dict[type[Effect], list[int]]()
        for kind, score in scores.items():
            first = sum(column.shape[1] for column in columns)
            self._places[kind] = list(range(first, first + score.directions.shape[1]))
            size = np.linalg.norm(score.directions, axis=0)
            columns.append(score.directions / np.where(size > 0.0, size, 1.0))
        all_of_them = np.concatenate(columns, axis=1) if columns else np.empty((0, 0))
        self._gram = all_of_them.T @ all_of_them
        self._along = all_of_them.T @ screen.residual if columns else np.empty(0)

    def of(self, one: type[Effect], other: type[Effect]) -> _Pair | None:
        """Return two effects as a pair, None unless both are needed."""
        both, alone = self._fall(one, other), {kind: self._fall(kind) for kind in (one, other)}
        first, second = sorted(alone, key=lambda kind: -alone[kind])
        prices = {kind: self._screen.price(kind) for kind in alone}
        worth = both - sum(prices.values())
        if self._is_chance(both, worth, one, other):
            return None
        if both - alone[first] <= prices[second] or both - alone[second] <= prices[first]:
            return None
        return _Pair((first, second), worth)

    def _fall(self, *kinds: type[Effect]) -> float:
        """Return by how much effects together lower the deviance."""
        places = [place for kind in kinds for place in self._places[kind]]
        along = self._along[places]
        gram = self._gram[np.ix_(places, places)]
        return float(along @ np.linalg.pinv(gram, rcond=1e-10, hermitian=True) @ along)

    def _is_chance(self, fall: float, worth: float, *kinds: type[Effect]) -> bool:
        shapes = float(np.prod([self._scores[kind].shapes for kind in kinds]))
        numbers = sum(len(kind.specs()) for kind in kinds)
        return may_be_chance(chance_of_fall(fall, numbers, shapes), worth, self._tried)
