"""The base of every effect: what a file in this folder must declare."""

from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import Any, ClassVar

from diffbot_sim.parameters import Spec, specs
from diffbot_sim.physics.stages import Stage, Traction


@dataclass(frozen=True)
class Effect:
    """Something that real robots do and the nominal model lacks.

    A subclass is a frozen dataclass whose fields are its parameters; each default is neutral:
    there the effect changes no bit of the result.

    name: key in YAML and reports.
    meaning: one line for people; source: where the law comes from.
    stage: where the kernel acts.
    kernel: compiled `kernel(at, value, *state, *parameters) -> value`.
    states: how many numbers of state it keeps (stage ACTUATOR or COMMAND only).
    update: compiled, same arguments; returns the state after `at.elapsed` seconds.
    dissipative: whether it can only take energy away.
    guesses: departures from neutral, one value for each parameter, from which fits start.
    excitation: the drive that shows it.
    """

    name: ClassVar[str]
    meaning: ClassVar[str]
    source: ClassVar[str]
    stage: ClassVar[Stage]
    kernel: ClassVar[Callable[..., Any]]
    states: ClassVar[int] = 0
    update: ClassVar[Callable[..., Any] | None] = None
    dissipative: ClassVar[bool] = False
    guesses: ClassVar[tuple[tuple[float, ...], ...]]
    excitation: ClassVar[str]

    @classmethod
    def specs(cls) -> tuple[Spec, ...]:
        """List the parameters in order."""
        return specs(cls)

    @property
    def values(self) -> tuple[float, ...]:
        """The parameter values in the order of the fields."""
        return tuple(float(getattr(self, item.name)) for item in fields(self))

    @classmethod
    def initial_state(cls, command: Traction) -> tuple[float, ...]:
        """Return the state of a robot that has had this command for long."""
        del command
        return ()
