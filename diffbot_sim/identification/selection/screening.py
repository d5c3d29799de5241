"""Cheap screening: how much of the residual each effect could explain, to first order."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from operator import itemgetter

import numpy as np

from diffbot_sim.identification.fitting.coordinates import Space, point_of
from diffbot_sim.identification.fitting.fit import Fit, whitened
from diffbot_sim.identification.fitting.periodicity import wheel_orders
from diffbot_sim.identification.fitting.response import Response, responses
from diffbot_sim.identification.fitting.views import views
from diffbot_sim.identification.recordings.stretches import largest_command
from diffbot_sim.identification.selection.onsets import Onsets
from diffbot_sim.identification.statistics.guards import chance_of_fall
from diffbot_sim.identification.statistics.minimisation import slope
from diffbot_sim.identification.statistics.parallel import each
from diffbot_sim.identification.statistics.projection import Projection
from diffbot_sim.identification.statistics.robust import influence
from diffbot_sim.physics.effects import Effect, Excitation
from diffbot_sim.records import Array

# A small amount of an effect, in coordinates of order one.
AMOUNT = 0.05
# Only what could not plausibly be chance is worth a full fit.
PROMISING = 0.02
# First order promises too much where parameters would move far: shares of a step that are tried.
SHARES = (1.0, 0.5)
# How many options are compared by their actual error, and how many of them may be followed.
COMPARED, FOLLOWED = 6, 2
# Slopes of the errors at a point, along the coordinates at some places.
Slopes = Callable[[Array, list[int]], Array]


@dataclass(frozen=True)
class Score:
    """First-order worth of an effect.

    ratio: estimate of the likelihood ratio; p_value: its chance under no effect, counting the
    shapes tried; points: of what promises most, the best first, those (u of the larger space) at
    one of which a full fit may begin; seen: whether the drive shows the effect at all once the
    free parameters have adapted; shapes: how many were tried; directions: what it does to the
    errors in that which explains most, beyond what the free parameters could, shape (2 n, q).
    """

    ratio: float
    p_value: float
    points: tuple[tuple[Array, ...], ...]
    seen: bool
    shapes: int
    directions: Array


class Screen:
    """Residual of one fit with everything that its free parameters could explain taken out."""

    def __init__(self, fit: Fit) -> None:
        self.fit = fit
        self._free = Projection(fit.slopes)
        self._errors = self.project(influence(fit.whitened))
        self._scores = dict[type[Effect], Score]()
        self._starts = dict[type[Effect], tuple[Array, ...]]()

    @property
    def residual(self) -> Array:
        """The errors that free parameters cannot explain, shape (2 n,)."""
        return self._errors.ravel()

    @cached_property
    def _solve(self) -> Array:
        """What turns errors into parameters that explain them; not every screen is asked."""
        return np.asarray(np.linalg.pinv(self.fit.slopes, rcond=1e-8))

    def adaptation(self, sensitivity: Array, amount: Array) -> Array:
        """Return how the free parameters shift when an amount of something is added."""
        change = sensitivity.reshape(-1, sensitivity.shape[-1]) @ amount
        return np.asarray(-self._solve @ change)

    def project(self, values: Array) -> Array:
        """Take out of values, shape (n, 2) or (n, 2, q), what the free parameters explain."""
        return self._free.rest(values)

    def explained(self, sensitivity: Array) -> tuple[float, Array, Array]:
        """Return the fall of the squared error, the coefficients, the projected sensitivity."""
        flat = self.project(sensitivity).reshape(-1, sensitivity.shape[-1])
        errors = self.residual
        amount, *_ = np.linalg.lstsq(flat, -errors, rcond=1e-8)
        fall = float(errors @ errors - np.sum((errors + flat @ amount) ** 2))
        return fall, np.asarray(amount), flat

    def price(self, kind: type[Effect]) -> float:
        """Return what the parameters of an effect cost in BIC."""
        return self.fit.price(len(kind.specs()))

    def score(self, kind: type[Effect]) -> Score:
        """Try small amounts of an effect, in each of its shapes, and its starts as they stand."""
        if kind not in self._scores:
            self._scores[kind] = self._scored(kind)
        return self._scores[kind]

    def starts(self, kind: type[Effect]) -> tuple[Array, ...]:
        """Return points, u of a space with the effect, at which full fits should begin.

        The one that promises most, and of the next ones that with the least error.
        """
        if kind not in self._starts:
            first, *others = each(partial(self._least, self._with(kind)), self.score(kind).points)
            others.sort(key=itemgetter(0))
            self._starts[kind] = tuple(point for _, point in (first, *others[: FOLLOWED - 1]))
        return self._starts[kind]

    def _with(self, kind: type[Effect]) -> Space:
        return Space(self.fit.space.declared, (*self.fit.space.kinds, kind))

    def _scored(self, kind: type[Effect]) -> Score:
        space = self._with(kind)
        starts = [point_of(kind, values) for values in kind.starts(self.drive)]
        slopes_of = self._slopes_of(space, kind)
        if kind.shape:
            options = each(partial(self._amounts, space, kind, slopes_of), starts)
        else:
            neutral = point_of(kind, [spec.default for spec in kind.specs()])
            options = each(partial(self._as_it_stands, space), starts)
            options.append(self._amounts(space, kind, slopes_of, neutral))
        promising = sorted(options, key=lambda option: -option.fall)[:COMPARED]
        best, shapes = promising[0], len(starts) if kind.shape else 1
        return Score(
            best.fall,
            chance_of_fall(best.fall, len(kind.specs()), shapes),
            tuple(option.points for option in promising),
            any(option.seen for option in options),
            shapes,
            best.directions,
        )

    @cached_property
    def drive(self) -> Excitation:
        """What the fitted stretches offer to starting points."""
        stretches, seen = self.fit.stretches, views(self.fit, self.fit.stretches)
        return Excitation(
            force=largest_command(stretches),
            duration=max(float(s.time[-1]) for s in stretches),
            orders=wheel_orders(seen),
            power=max(0.01, *(float((v.force * v.wheel_speed).max()) for v in seen)),
            speed=max(0.01, *(float(np.abs(v.wheel_speed).max()) for v in seen)),
        )

    @cached_property
    def responses(self) -> tuple[Response, ...]:
        """How the errors on each stretch answer to pushes on the body."""
        return responses(self.fit)

    @cached_property
    def onsets(self) -> Onsets:
        """How the errors answer to effects that set in at a moment."""
        return Onsets(self.fit, self.responses, AMOUNT)

    def _amounts(
        self, space: Space, kind: type[Effect], slopes_of: Slopes, at: Array
    ) -> '_Option':
        """Return the amounts of an effect, of the shape that `at` has, that explain most."""
        size = len(self.fit.u)
        neutral = [
            x if spec.name in kind.shape else c.prior
            for spec, c, x in zip(kind.specs(), space.of_effects[-len(at) :], at, strict=True)
        ]
        point = np.concatenate([self.fit.u, neutral])
        turned = [i for i, spec in enumerate(kind.specs()) if spec.name not in kind.shape]
        slopes = slopes_of(point, [size + i for i in turned])
        fall, amount, flat = self.explained(slopes)
        change = np.zeros(len(point))
        change[[size + i for i in turned]] = amount
        change[:size] = self.adaptation(slopes, amount)[:size]
        return _Option(fall, self._shares(space, point, change), _is_seen(flat, slopes), flat)

    def _shares(self, space: Space, point: Array, change: Array) -> tuple[Array, ...]:
        """Return points on the way along a change, with and without what it does to others."""
        alone = np.where(np.arange(len(point)) < len(self.fit.u), 0.0, change)
        bounds = space.bounds()
        return tuple(
            np.clip(point + share * by, *bounds) for share in SHARES for by in (change, alone)
        )

    def _as_it_stands(self, space: Space, start: Array) -> '_Option':
        """Return what values that are far from neutral explain."""
        point = np.concatenate([self.fit.u, start])
        change = (self._errors_at(space, point) - self.fit.whitened)[..., None]
        fall, _, flat = self.explained(change)
        return _Option(fall, (point,), _is_seen(flat, change), flat)

    def _errors_at(self, space: Space, point: Array) -> Array:
        return whitened(self.fit.stretches, space.model(point), self.fit.gains, self.fit.sigma)

    def _slopes_of(self, space: Space, kind: type[Effect]) -> Slopes:
        """Return what gives the slopes of the errors along amounts of an effect, (n, 2, q)."""
        if kind.onset is None:
            return partial(self._slopes, space)
        names = [spec.name for spec in kind.specs()]
        # Made here: its own work is on all cores.
        return partial(self.onsets.slopes, space, len(self.fit.u) + names.index(kind.onset))

    def _slopes(self, space: Space, point: Array, turned: list[int]) -> Array:
        errors, base, low = partial(self._errors_at, space), self.fit.whitened, space.bounds()[0]
        slopes = [slope(errors, point, base, index, AMOUNT, low[index]) for index in turned]
        return np.stack(slopes, axis=-1)

    def _least(self, space: Space, points: Sequence[Array]) -> tuple[float, Array]:
        """Return the least error of some points, and the point that has it."""
        losses = [self._loss(space, point) for point in points]
        best = int(np.argmin(losses))
        return losses[best], points[best]

    def _loss(self, space: Space, point: Array) -> float:
        """Return the squared error at a point, no sample counting beyond three deviations."""
        return float(np.sum(influence(self._errors_at(space, point)) ** 2))


@dataclass(frozen=True)
class _Option:
    """Points at one of which a full fit may begin, and how much that promises; as in Score."""

    fall: float
    points: tuple[Array, ...]
    seen: bool
    directions: Array


def _is_seen(flat: Array, slopes: Array) -> bool:
    """Say whether anything is left once the free parameters have adapted."""
    left = float(np.linalg.norm(flat))
    return left > 1e-2 and left > 1e-3 * float(np.linalg.norm(slopes))
