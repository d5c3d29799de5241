"""An independent plant: two wheels with friction (13), events by scipy, nothing of ours inside.

Written from the physics alone: the mass matrix of the wheel speeds, a mode for each wheel
(0 sticks, ±1 slides that way), and DOP853 from one change of mode to the next.
"""

from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

Array = NDArray[np.float64]
Modes = tuple[int, ...]


@dataclass(frozen=True)
class ReferencePlant:
    """A robot [kg, kg·m², m] whose wheels obey (13) [N, N, N·s/m, s/m]."""

    mass: float
    inertia: float
    half_separation: float
    static: float
    coulomb: float
    viscous: float
    stribeck: float

    def drive(self, stamps: Array, forces: Array, times: Array) -> tuple[Array, int]:
        """Start at rest; return x, y, heading, v_R, v_L at the times, and the count of events.

        Each pair of forces holds from its stamp to the next; times lie within stamps.
        """
        state, rows, events = np.zeros(5), [np.zeros(5)], 0
        for begin, end, force in zip(stamps[:-1], stamps[1:], forces, strict=True):
            wanted, modes = times[(times > begin) & (times <= end)], self._modes(state, force)
            time = begin
            while time < end:
                run = self._until_event(time, end, state, force, modes)
                time, state = run.t[-1], run.y[:, -1].copy()
                rows.extend(run.sol(stamp) for stamp in wanted[wanted <= time])
                wanted = wanted[wanted > time]
                if run.status == 1:
                    events, modes = events + 1, self._changed(run, state, force, modes)
        return np.array(rows), events

    def _until_event(
        self, begin: float, end: float, state: Array, force: Array, modes: Modes
    ) -> Any:
        """Integrate until a wheel stops, a stuck one breaks away, or the end."""

        def rate(_: float, z: Array) -> Array:
            acceleration, _friction = self._forces(z[3:], force, modes)
            v, omega = 0.5 * (z[3] + z[4]), (z[3] - z[4]) / (2.0 * self.half_separation)
            return np.array([v * np.cos(z[2]), v * np.sin(z[2]), omega, *acceleration])

        def margin(wheel: int) -> Any:
            def left(_: float, z: Array) -> float:
                if modes[wheel]:
                    return float(modes[wheel] * z[3 + wheel])
                return self.static - abs(self._forces(z[3:], force, modes)[1][wheel])

            left.terminal, left.direction = True, -1  # type: ignore[attr-defined]
            return left

        tight = {'rtol': 1e-12, 'atol': 1e-14, 'max_step': 0.1}
        events = [margin(0), margin(1)]
        return solve_ivp(
            rate, (begin, end), state, 'DOP853', dense_output=True, events=events, **tight
        )

    def _changed(self, run: Any, state: Array, force: Array, modes: Modes) -> Modes:
        """Return the modes after an event; stop, exactly, a wheel that has reached 0."""
        torn = {}
        for wheel, times in enumerate(run.t_events):
            if len(times) and modes[wheel]:
                state[3 + wheel] = 0.0
            elif len(times):
                torn[wheel] = int(np.sign(self._forces(state[3:], force, modes)[1][wheel]))
        return self._modes(state, force, torn)

    def _modes(self, state: Array, force: Array, torn: Any = ()) -> Modes:
        """Return the modes that agree with the motion they cause; torn: known directions."""
        speed = state[3:]
        options = [(int(np.sign(v)),) if v else (0, 1, -1) for v in speed]
        for wheel in torn:
            options[wheel] = (torn[wheel],)
        open_wheels = [i for i, choice in enumerate(options) if len(choice) > 1]
        for modes in product(*options):
            acceleration, friction = self._forces(speed, force, modes)
            if all(
                modes[i] * acceleration[i] > 0.0 if modes[i] else abs(friction[i]) < self.static
                for i in open_wheels
            ):
                return modes
        raise AssertionError(f'no motion agrees with {force} N at {speed} m/s')

    def _forces(self, speed: Array, force: Array, modes: Modes) -> tuple[Array, Array]:
        """Return the wheels' accelerations, and their friction: by law, or what sticking takes."""
        sign, slides = np.array(modes), np.array(modes) != 0
        rubbing = self.coulomb + (self.static - self.coulomb) * np.exp(
            -self.stribeck * sign * speed
        )
        friction = sign * rubbing + self.viscous * speed
        along, about = self.mass / 4.0, self.inertia / (2.0 * self.half_separation) ** 2
        matrix = np.array([[along + about, along - about], [along - about, along + about]])
        acceleration = np.zeros(2)
        if slides.any():
            moving = matrix[np.ix_(slides, slides)]
            acceleration[slides] = np.linalg.solve(moving, (force - friction)[slides])
        return acceleration, np.where(slides, friction, force - matrix @ acceleration)
