"""Short ways to drive a simulated robot, and the robots and drives that properties draw."""

from typing import Any

import numpy as np
from hypothesis import strategies as st

from diffbot_sim.physics import Friction, Model, Robot, simulate
from diffbot_sim.physics.friction import MODELS
from diffbot_sim.physics.state import State
from diffbot_sim.records import Commands, Trajectory

Row = tuple[float, float, float]


def commands(*rows: Row) -> Commands:
    """Make commands from rows of stamp [s], right and left force [N]."""
    table = np.array(rows, dtype=float)
    return Commands(table[:, 0].copy(), table[:, 1:].copy())


def drive(model: Model, *rows: Row, until: float, every: float = 0.05, **how: Any) -> Trajectory:
    """Simulate from time 0 with a stamp `every` so many seconds."""
    times = np.linspace(0.0, until, round(until / every) + 1)
    return simulate(model, commands(*rows), times, **how)


def push(model: Model, right: float, left: float, until: float, **how: Any) -> Trajectory:
    """Hold one pair of forces [N]."""
    return drive(model, (0.0, right, left), until=until, **how)


def table(run: Trajectory) -> Any:
    """Put all that a run says into one array."""
    columns = (run.pose, run.twist, run.wheel_angle, run.wheel_speed, run.traction, run.friction)
    return np.column_stack([run.time, *columns])


def kinetic_energy(robot: Robot, run: Trajectory) -> Any:
    """Return ½ m v² + ½ J ω² [J] at each stamp."""
    v, omega = run.twist.T
    return 0.5 * robot.mass * v**2 + 0.5 * robot.inertia * omega**2


def traction_work(robot: Robot, run: Trajectory) -> Any:
    """Return the work [J] done since the start by forces that hold still between stamps."""
    way = np.diff(run.wheel_angle, axis=0) * robot.wheel_radius
    return np.concatenate([[0.0], np.cumsum(np.sum(run.traction[:-1] * way, axis=1))])


def numbers(low: float, high: float) -> st.SearchStrategy[float]:
    """Draw from an interval, and often its ends, 0 and what is almost 0."""
    hard = [x for x in (low, high, 0.0, 1e-7, -1e-7) if low <= x <= high]
    return st.sampled_from(hard) | st.floats(low, high, allow_subnormal=False)


@st.composite
def robots(draw: st.DrawFn) -> Robot:
    """Draw from a toy to a tractor, with the mass within reach of the wheels."""
    mass, separation = draw(st.floats(0.1, 1000.0)), draw(st.floats(0.05, 2.0))
    gyration = draw(st.floats(0.3, 1.5)) * separation / 2.0
    return Robot(mass, mass * gyration**2, separation, draw(st.floats(0.01, 0.5)))


@st.composite
def frictions(draw: st.DrawFn, models: tuple[str, ...] = MODELS) -> Friction:
    """Draw a law in which sliding friction is at most static friction."""
    static = draw(numbers(0.0, 1.0))
    return Friction(
        model=draw(st.sampled_from(models)),
        normal_force=draw(st.floats(1.0, 1000.0)),
        mu_static=static,
        mu_coulomb=static * draw(numbers(0.0, 1.0)),
        mu_viscous=draw(numbers(0.0, 2.0)),
        stribeck=draw(numbers(0.0, 100.0)),
    )


def models(effects: Any = ()) -> st.SearchStrategy[Model]:
    """Draw robot and friction, each on its own."""
    return st.builds(Model, robots(), frictions(), st.just(tuple(effects)))


def forces(most: float = 100.0) -> st.SearchStrategy[float]:
    """Draw a force [N]."""
    return numbers(-most, most)


@st.composite
def drives(draw: st.DrawFn, most: float = 100.0) -> list[Row]:
    """Draw a few pairs of forces [N], each held for 0.25 s."""
    pairs = draw(st.lists(st.tuples(forces(most), forces(most)), min_size=1, max_size=8))
    return [(0.25 * i, right, left) for i, (right, left) in enumerate(pairs)]


def starts() -> st.SearchStrategy[State]:
    """Draw a pose and a twist, often at rest or almost."""
    pose = (numbers(-100.0, 100.0), numbers(-100.0, 100.0), numbers(-7.0, 7.0))
    return st.builds(State, *pose, numbers(-5.0, 5.0), numbers(-5.0, 5.0))
