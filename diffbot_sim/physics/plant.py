"""A live robot that a node steps: the same compiled physics, one tick at a time."""

from collections import deque
from math import inf

import numpy as np
from numba import types

from diffbot_sim.physics.compiled import entry
from diffbot_sim.physics.composition import compose
from diffbot_sim.physics.dynamics import ARRAY, FUNCTION_TYPES, INTEGERS, MATRIX, Dynamics
from diffbot_sim.physics.instant import Inputs
from diffbot_sim.physics.model import Model
from diffbot_sim.physics.schedule import delay_of, moments_of
from diffbot_sim.physics.simulation import (
    FRICTION,
    OUTPUT_SIZE,
    TRACTION,
    TWIST,
    WHEEL_ANGLE,
    WHEEL_SPEED,
    initial_modes,
    initial_vector,
    observe,
    workspace,
)
from diffbot_sim.physics.stages import Traction
from diffbot_sim.physics.state import State
from diffbot_sim.physics.stepper import advance_through
from diffbot_sim.physics.vector import SPEED_RIGHT


class Plant:
    """A robot in motion; starts at rest at the origin at time 0.

    Steps of the integrator are at most max_step [s] long.
    """

    def __init__(self, model: Model, max_step: float = 1e-3, start: State | None = None) -> None:
        self._max_step = max_step
        self._model = model
        self.reset(start)

    def reset(self, start: State | None = None) -> None:
        """Put the robot at a start (rest at the origin) and time 0."""
        self.time = 0.0
        self.place(start or State())

    def place(self, start: State) -> None:
        """Put the robot somewhere else, free of forces; time goes on."""
        self._force = (0.0, 0.0)
        self._coming = deque[tuple[float, tuple[float, float]]]()
        self._z = initial_vector(self._model, start)
        self._install(self._model)

    @property
    def model(self) -> Model:
        """What is simulated; a new model takes over pose and speed, its effects start afresh.

        Forces on their way arrive all the same, unless the delay is another one.
        """
        return self._model

    @model.setter
    def model(self, model: Model) -> None:
        if model.half_separation != self._model.half_separation:
            there = initial_vector(model, State(0.0, 0.0, 0.0, *self.twist))
            self._z[SPEED_RIGHT:] = there[SPEED_RIGHT:]
        if delay_of(model) != self._delay:
            self._coming.clear()
        self._install(model)

    def step(self, force_right: float, force_left: float, duration: float) -> None:
        """Hold forces [N] on the wheels for a duration [s]."""
        self._take((force_right, force_left))
        end = self.time + duration
        while (cut := self._next_cut()) < end:
            self._run(cut - self.time)
            self.time = cut
            self._arrive()
            duration = end - cut
        self._run(duration)
        self.time = end
        self._arrive()

    def command(self, force_right: float, force_left: float) -> None:
        """Take forces [N] without advancing, so that friction shows what they meet."""
        self._take((force_right, force_left))
        self._run(0.0)

    def _take(self, force: tuple[float, float]) -> None:
        """Let forces act, at once or when they arrive."""
        if self._delay == 0.0:
            self._force = force
            return
        while self._coming and self._coming[-1][0] >= self.time + self._delay:
            self._coming.pop()  # given at this very moment: the later word counts
        self._coming.append((self.time + self._delay, force))

    def _next_cut(self) -> float:
        """Return when a delayed command arrives or an effect changes abruptly next; or never."""
        cuts = [arrival for arrival, _ in self._coming] + list(self._moments)
        return min((cut for cut in cuts if cut > self.time), default=inf)

    def _arrive(self) -> None:
        while self._coming and self._coming[0][0] <= self.time:
            self._force = self._coming.popleft()[1]

    @property
    def pose(self) -> tuple[float, float, float]:
        """x [m], y [m] and heading [rad, not wrapped]."""
        return float(self._row[0]), float(self._row[1]), float(self._row[2])

    @property
    def wheel_angle(self) -> tuple[float, float]:
        """Angles of the right and left wheel [rad]."""
        return self._pair(WHEEL_ANGLE)

    @property
    def wheel_speed(self) -> tuple[float, float]:
        """Rim speeds of the right and left wheel [m/s]."""
        return self._pair(WHEEL_SPEED)

    @property
    def twist(self) -> tuple[float, float]:
        """v [m/s] and ω [rad/s]."""
        return self._pair(TWIST)

    @property
    def traction(self) -> tuple[float, float]:
        """Forces acting on the right and left wheel [N], after any actuator effect."""
        return self._pair(TRACTION)

    @property
    def friction(self) -> tuple[float, float]:
        """F_fr of the right and left wheel [N]: eq. (13), positive opposes forward motion."""
        return self._pair(FRICTION)

    def _pair(self, column: int) -> tuple[float, float]:
        return float(self._row[column]), float(self._row[column + 1])

    def _install(self, model: Model) -> None:
        self._model = model
        self._functions = compose(model.kinds)
        self._params = model.pack()
        self._delay, self._moments = delay_of(model), moments_of(model)
        held = Traction(*self._force)
        self._states = np.array([s for e in model.effects for s in e.initial_state(held)])
        self._modes, self._work = workspace()
        self._row = np.empty(OUTPUT_SIZE)
        _begin(*self._arguments())
        self._run(0.0)

    def _run(self, duration: float) -> None:
        _step(*self._arguments(), duration, self._max_step, self._work, self._row)

    def _arguments(self) -> tuple[object, ...]:
        arrays = (self._params, self._states, self._z, self._modes)
        return (*self._functions, *arrays, *self._force, self.time)


_SYSTEM = (*FUNCTION_TYPES, ARRAY, ARRAY, ARRAY, INTEGERS, *(types.float64,) * 3)


@entry(types.void(*_SYSTEM))
def _begin(  # type: ignore[no-untyped-def]
    laws, settle, step, params, states, z, modes, right, left, time
) -> None:
    """Set the modes of a robot whose history is unknown."""
    initial_modes(laws, params, states, z, modes, Inputs(right, left, 0.0, 0.0), time)


@entry(types.void(*_SYSTEM, types.float64, types.float64, MATRIX, ARRAY))
def _step(  # type: ignore[no-untyped-def]
    laws,
    settle,
    step,
    params,
    states,
    z,
    modes,
    right,
    left,
    time,
    duration,
    max_step,
    work,
    row,
) -> None:
    """Advance under held forces and observe the result."""
    dynamics, inputs = Dynamics(laws, settle, step), Inputs(right, left, 0.0, 0.0)
    advance_through(dynamics, params, states, z, modes, inputs, time, duration, max_step, work)
    observe(laws, params, states, z, modes, inputs, time + duration, row)
