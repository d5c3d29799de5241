"""Whether a robot's numbers are declared in their units: no fit goes as far as from g to kg."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from diffbot_sim.errors import DataError
from diffbot_sim.identification.fitting.calibration import simulation_errors
from diffbot_sim.identification.fitting.coordinates import Space
from diffbot_sim.identification.recordings.stretches import Stretch, motion_of
from diffbot_sim.identification.statistics.norms import rms_of_each
from diffbot_sim.parameters import Spec, specs
from diffbot_sim.physics.model import Model

# Powers of ten that a number is wrong by in another unit: g, kg·cm², cm.
UNITS = {'mass': (-4, -3, 3, 4), 'inertia': (-4, -3, 3, 4), 'wheel_separation': (-3, -2, 2, 3)}
# Those that a bad guess is wrong by: a fit goes on from there.
GUESSES = {'mass': (-2, 2), 'inertia': (-2, 2), 'wheel_separation': ()}
# The numbers that v tells of, and those that ω tells of, likelier mistakes first.
TELLING = (('mass',), ('inertia', 'wheel_separation'))
# It is wrong if without it less than this share is left of the motion, and of the error.
LEFT = 0.5


@dataclass(frozen=True)
class Mistake:
    """A number of a robot, the power of ten that was forgotten, and the model that has it."""

    number: Spec
    power: int
    model: Model

    @property
    def is_of_unit(self) -> bool:
        """Whether another unit accounts for it, and no bad guess."""
        return self.power in UNITS[self.number.name]


def within_reach(declared: Model, stretches: tuple[Stretch, ...]) -> Model:
    """Return what was declared, a mass or inertia guessed too badly for a fit set nearer.

    Raises DataError where a number moves as the runs do in another unit only.
    """
    nearest = declared
    for axis, names in enumerate(TELLING):
        mistake = _mistake(nearest, stretches, axis, names)
        if mistake and mistake.is_of_unit:
            raise _refusal(declared, mistake)
        nearest = mistake.model if mistake else nearest
    return nearest


def _mistake(
    declared: Model, stretches: tuple[Stretch, ...], axis: int, names: tuple[str, ...]
) -> Mistake | None:
    """Return that of v (0) or ω (1) without which less than half the error is left, if any."""

    def error(model: Model) -> float:
        space = Space(model, ())
        return float(rms_of_each(simulation_errors(space, stretches, space.prior()))[axis])

    # Around its mean: that is all that a body leaves which is too heavy to change its speed.
    motion, as_declared = float(motion_of(stretches)[axis]), error(declared)
    if as_declared < LEFT * motion:
        return None
    found, least = None, min(motion, as_declared)
    for name in names:
        errors = [(error(it.model), it) for it in _mistakes(declared, name)]
        left, nearest = min(errors, key=lambda pair: pair[0])
        if left < LEFT * least:
            found, least = nearest, left
    return found


def _mistakes(declared: Model, name: str) -> Iterator[Mistake]:
    """Yield what a number may have been declared instead of, within its valid range."""
    (spec,) = (spec for spec in specs(declared.robot) if spec.name == name)
    value = getattr(declared.robot, name)
    for power in (*UNITS[name], *GUESSES[name]):
        meant = float(np.clip(value * 10.0**power, spec.low, spec.high))
        yield Mistake(
            spec, power, replace(declared, robot=replace(declared.robot, **{name: meant}))
        )


def _refusal(declared: Model, mistake: Mistake) -> DataError:
    name, unit = mistake.number.name, mistake.number.unit
    told, moves = (getattr(model.robot, name) for model in (declared, mistake.model))
    return DataError(
        f'robot.{name} is declared as {told:g} {unit}, and the runs move as with {moves:g}: '
        f'is that another unit? Declare it in {unit}.'
    )
