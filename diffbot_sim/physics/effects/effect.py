"""The base of every effect: what a file in this folder must declare."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar, NamedTuple

from diffbot_sim.parameters import Spec, specs
from diffbot_sim.physics.stages import Stage, Traction


class Excitation(NamedTuple):
    """What a recorded drive offers, for fits whose starting points depend on it.

    force: largest command [N]; duration: of the longest run [s]; orders: cycles per wheel
    revolution at which the residual is strongest; power: largest of command times speed [W];
    speed: largest of a wheel [m/s].
    """

    force: float
    duration: float
    orders: tuple[float, ...] = ()
    power: float = 100.0
    speed: float = 1.0


@dataclass(frozen=True)
class Effect:
    """Something that real robots do and the nominal model lacks.

    A subclass is a frozen dataclass whose fields are its parameters; each default is neutral:
    there the effect changes no bit of the result.

    name: key in YAML and reports.
    meaning: one line for people; source: where the law comes from.
    stage: where the kernel acts.
    kernel: compiled `kernel(at, value, *state, *parameters) -> value`.
    friction_kernel: compiled, likewise, for stage WHEEL_FRICTION: of what acts elsewhere, but is
    felt there, too.
    states: how many numbers of state it keeps (stages COMMAND, ACTUATOR and DRIVETRAIN only).
    update: compiled, same arguments; returns the state after `at.elapsed` seconds.
    dissipative: whether it can only take energy away.
    is_sought: whether identification looks for it; False for mere descriptions, and for what takes
    the place of other effects in too many drives. Declared, it acts all the same.
    is_of_time: whether it counts time from the start of the run.
    is_of_place: whether its kernel reads at.x or at.y: predictions tell those to no other.
    guesses: values of the parameters from which fits start.
    shape: names of parameters that mean nothing while the others are neutral (a moment, a period).
    essential: names of parameters that make it what it is: neutral, they leave another effect.
    onset: which of them is a moment before which it does nothing, and after which it acts as it
    would from the start of the run.
    excitation: the drive that shows it.
    """

    name: ClassVar[str]
    meaning: ClassVar[str]
    source: ClassVar[str]
    stage: ClassVar[Stage]
    kernel: ClassVar[Callable[..., Any]]
    friction_kernel: ClassVar[Callable[..., Any] | None] = None
    states: ClassVar[int] = 0
    update: ClassVar[Callable[..., Any] | None] = None
    dissipative: ClassVar[bool] = False
    is_sought: ClassVar[bool] = True
    is_of_time: ClassVar[bool] = False
    is_of_place: ClassVar[bool] = False
    guesses: ClassVar[tuple[tuple[Any, ...], ...]]
    shape: ClassVar[tuple[str, ...]] = ()
    essential: ClassVar[tuple[str, ...]] = ()
    onset: ClassVar[str | None] = None
    excitation: ClassVar[str]

    @classmethod
    def specs(cls) -> tuple[Spec, ...]:
        """List the parameters in order."""
        return specs(cls)

    @cached_property
    def values(self) -> tuple[float, ...]:
        """The parameter values in the order of the fields; a choice as its place."""
        return tuple(_number(spec, getattr(self, spec.name)) for spec in self.specs())

    @property
    def delay(self) -> float:
        """By how much commands come late [s]."""
        return 0.0

    @property
    def track(self) -> float:
        """By what factor the wheels are farther apart than declared."""
        return 1.0

    @property
    def moments(self) -> tuple[float, ...]:
        """When the kernel changes abruptly, in time of the run [s]: steps are cut there."""
        return ()

    @property
    def is_credible(self) -> bool:
        """Whether robots have such values: a fit that ends elsewhere is about something else."""
        return True

    @classmethod
    def starts(cls, drive: Excitation) -> tuple[tuple[float, ...], ...]:
        """Return values of the parameters from which fits to this drive start."""
        del drive
        return cls.guesses

    @classmethod
    def initial_state(cls, command: Traction) -> tuple[float, ...]:
        """Return the state of a robot that has had this command for long."""
        del command
        return ()


def _number(spec: Spec, value: Any) -> float:
    return float(spec.choices.index(value) if spec.choices else value)
