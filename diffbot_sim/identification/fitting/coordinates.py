"""The numbers that a fit may turn, and the model that they stand for."""

from collections.abc import Callable, Container, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import exp, log
from typing import Any

import numpy as np

from diffbot_sim.parameters import Spec, specs
from diffbot_sim.physics.effects import Effect
from diffbot_sim.physics.model import Model
from diffbot_sim.records import Array

# A parameter that the data leaves open stays near its declared value: one standard deviation of
# this weak prior is a factor e, or one declared value, and weighs as much as one sample.
PRIOR_DEVIATION = 1.0
# Effects of heavy robots are many times the typical size: so far from neutral they may well be, as
# far as their range goes.
EFFECT_DEVIATION = 100.0
# What has no meaning while an effect is neutral has no prior to speak of.
NO_PRIOR = 1e4
# What is fitted of the robot; its geometry is known.
FITTED_OF_ROBOT = ('mass', 'inertia')
# Widest factor between a declared and a fitted mass, inertia or Stribeck coefficient.
WIDEST_FACTOR = 30.0


@dataclass(frozen=True)
class Coordinate:
    """One number of a fit: dimensionless, of order one, `prior` where nothing is known.

    value turns it into the parameter's own unit, in which valid are its lowest and highest value;
    deviation: the standard deviation of the prior; reciprocal: whether it is one over a parameter.
    """

    name: str
    unit: str
    prior: float
    low: float
    high: float
    value: Callable[[float], float]
    valid: tuple[float, float]
    deviation: float = PRIOR_DEVIATION
    reciprocal: bool = False


@dataclass(frozen=True)
class Space:
    """The nominal parameters of a declared model and those of some effects, as one vector."""

    declared: Model
    kinds: tuple[type[Effect], ...]

    @cached_property
    def nominal(self) -> tuple[Coordinate, ...]:
        """Coordinates of the nominal parameters."""
        robot = {spec.name: spec for spec in specs(self.declared.robot)}
        friction = {spec.name: spec for spec in specs(self.declared.friction)}
        result = [_positive(robot[n], getattr(self.declared.robot, n)) for n in FITTED_OF_ROBOT]
        for name in self.declared.friction.active:
            declared = getattr(self.declared.friction, name)
            if name == 'mu_static':
                # Fitted as its excess over mu_coulomb, so that the two cannot cross.
                declared = declared - self.declared.friction.mu_coulomb
            make = _positive if name == 'stribeck' and declared > 0.0 else _linear
            result.append(make(friction[name], declared))
        return tuple(result)

    @cached_property
    def of_effects(self) -> tuple[Coordinate, ...]:
        """Coordinates of the effects' parameters, neutral at their prior."""
        return tuple(_of_effect(kind, spec) for kind in self.kinds for spec in kind.specs())

    @cached_property
    def coordinates(self) -> tuple[Coordinate, ...]:
        """All coordinates: nominal, then effects."""
        return self.nominal + self.of_effects

    def places(self, effect: str) -> list[int]:
        """Return where the coordinates of an effect stand."""
        names = (coordinate.name for coordinate in self.coordinates)
        return [index for index, name in enumerate(names) if name.startswith(effect + '.')]

    def where(self, names: Container[str]) -> list[int]:
        """Return where the coordinates of these names stand, as far as there are any."""
        return [i for i, coordinate in enumerate(self.coordinates) if coordinate.name in names]

    @property
    def shapes(self) -> list[int]:
        """Where moments, periods and the like stand: they mean nothing without an amount."""
        return self.where({f'{kind.name}.{name}' for kind in self.kinds for name in kind.shape})

    @property
    def onsets(self) -> list[int]:
        """Where moments stand at which an effect sets in."""
        return self.where({f'{kind.name}.{kind.onset}' for kind in self.kinds if kind.onset})

    def model(self, u: Array) -> Model:
        """Return the model at a point."""
        values = self.values(u)
        robot = replace(self.declared.robot, mass=values['mass'], inertia=values['inertia'])
        active: dict[str, Any] = {n: values[n] for n in self.declared.friction.active}
        friction = replace(self.declared.friction, **active)
        own = {e.name: e for e in self.declared.effects}
        for kind in self.kinds:
            own[kind.name] = kind(
                **{s.name: values[f'{kind.name}.{s.name}'] for s in kind.specs()}
            )
        return Model(robot, friction, tuple(own.values()))

    def values(self, u: Array) -> dict[str, float]:
        """Return the parameters in their own units by name."""
        found = {c.name: c.value(float(x)) for c, x in zip(self.coordinates, u, strict=True)}
        if 'mu_static' in found:
            found['mu_static'] += found['mu_coulomb']
        return found

    def prior(self) -> Array:
        """Return the point at which all is as declared and every effect neutral."""
        return np.array([c.prior for c in self.coordinates])

    def deviations(self) -> Array:
        """Return how far from its prior each coordinate may well be."""
        return np.array([c.deviation for c in self.coordinates])

    def bounds(self) -> tuple[Array, Array]:
        """Return lowest and highest values of every coordinate."""
        return (
            np.array([c.low for c in self.coordinates]),
            np.array([c.high for c in self.coordinates]),
        )


def _of_effect(kind: type[Effect], spec: Spec) -> Coordinate:
    """Fit a parameter in units of a typical departure from neutral."""

    def value(u: float) -> float:
        return spec.scale / u if spec.reciprocal else u * spec.scale

    neutral, *ends = (_in_scale(spec, x) for x in (spec.default, spec.low, spec.high))
    widest = min(EFFECT_DEVIATION, max(ends) - min(ends))
    deviation = PRIOR_DEVIATION if spec.reciprocal else widest
    deviation = NO_PRIOR if spec.name in kind.shape else deviation
    name = f'{kind.name}.{spec.name}'
    low, high, valid = min(ends), max(ends), (spec.low, spec.high)
    fixed = (name, spec.unit, neutral, low, high, value, valid, deviation)
    return Coordinate(*fixed, reciprocal=spec.reciprocal)


def _in_scale(spec: Spec, value: float) -> float:
    return spec.scale / value if spec.reciprocal else value / spec.scale


def _positive(spec: Spec, declared: float) -> Coordinate:
    """Fit the logarithm of a parameter that cannot reach zero."""

    def value(u: float) -> float:
        return float(np.clip(declared * exp(u), spec.low, spec.high))

    widest = log(WIDEST_FACTOR)
    valid = (spec.low, spec.high)
    return Coordinate(spec.name, spec.unit, 0.0, -widest, widest, value, valid)


def _linear(spec: Spec, declared: float) -> Coordinate:
    """Fit a parameter that may be zero, in units of its declared size."""
    scale, valid = max(declared, spec.scale), (spec.low, spec.high)

    def value(u: float) -> float:
        return u * scale

    return Coordinate(spec.name, spec.unit, declared / scale, 0.0, spec.high / scale, value, valid)


def point_of(kind: type[Effect], values: Sequence[float]) -> Array:
    """Return an effect's coordinates for values of its parameters."""
    pairs = zip(kind.specs(), values, strict=True)
    return np.array([_in_scale(spec, value) for spec, value in pairs])
