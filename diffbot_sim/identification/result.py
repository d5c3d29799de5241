"""What identification concludes: frozen records that reports read and never change."""

from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from diffbot_sim.physics.effects.empirical_force import EmpiricalForce
from diffbot_sim.physics.effects.empirical_limit import EmpiricalLimit
from diffbot_sim.physics.effects.empirical_wheel_force import EmpiricalWheelForce
from diffbot_sim.physics.model import Model
from diffbot_sim.records import Array, Trajectory

# Tables of what has no name.
Table = EmpiricalForce | EmpiricalWheelForce | EmpiricalLimit

NOTHING_MISSING = 'nothing_missing'
EFFECTS_FOUND = 'effects_found'
UNEXPLAINED = 'unexplained'
# What is contradicted where the declared law of friction is too simple, beside names of effects.
LAW = 'friction.model'
# The variable of a structure that is a limit of the wheels' force over their speed.
LIMIT = 'limit'
# The variable of a structure that is a hill or a hollow of the floor.
ROUND_HILL = 'round_hill'


@dataclass(frozen=True)
class Estimate:
    """A parameter with its 95 % interval [low, high].

    at_bound: whether the fit was stopped by the lowest or highest valid value; the interval then
    means little.
    """

    value: float
    low: float
    high: float
    unit: str
    at_bound: bool = False


@dataclass(frozen=True)
class FoundEffect:
    """An effect that the declared model lacked.

    evidence: named figures, such as delta_bic, p_value, p_block, held_out_gain.
    alternatives: effects that this data cannot tell from it; separate_by: the drive that would.
    """

    name: str
    parameters: dict[str, Estimate]
    evidence: dict[str, float]
    alternatives: tuple[str, ...] = ()
    separate_by: str = ''


@dataclass(frozen=True)
class Candidate:
    """How one effect fared when it was last tried.

    score: fall of the BIC when the effect is added (positive favours it); p_value: of the
    likelihood ratio; p_block: the same, robust against serial correlation; held_out_gain: fall
    of the mean negative log likelihood on held-out data; outcome: what came of it, in words.
    """

    name: str
    score: float
    p_value: float
    p_block: float
    held_out_gain: float
    outcome: str
    parameters: dict[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Structure:
    """Structure left in the residual that no effect of the library accounts for.

    axis: 'v' (force along x, N), 'omega' (torque, N·m), 'wheels' (force on each wheel, N) or
    'difference' (on one wheel, and against it on the other, N); variable: what it depends on;
    over: what its curve is drawn over, with the unit; strength: rms of the force or torque
    explained by that variable; p_value: block-robust. worth: fall of the BIC when it acts. knots,
    force: the empirical curve, with force_error its standard error, for a plot; part: of what, if
    not of all of it, such as one wheel. spot: middle and radius [m] of the spot of the floor that
    it depends on, shape (3,); None where it depends on none.
    """

    description: str
    axis: str
    variable: str
    over: str
    strength: float
    p_value: float
    knots: Array
    force: Array
    force_error: Array
    worth: float = 0.0
    part: str = ''
    spot: Array | None = None


@dataclass(frozen=True)
class ErrorNorm:
    """Root mean square of an error in v [m/s] and ω [rad/s]."""

    v_rmse: float
    omega_rmse: float

    @classmethod
    def of(cls, pair: Array) -> 'ErrorNorm':
        """Return the norm that a pair (2,) of v [m/s] and ω [rad/s] tells."""
        v, omega = pair
        return cls(float(v), float(omega))

    @property
    def pair(self) -> Array:
        """Both as an array, shape (2,)."""
        return np.array([self.v_rmse, self.omega_rmse])


@dataclass(frozen=True)
class Errors:
    """Free-running simulation errors on held-out data, before and after.

    split: 'validate' (whole runs that were not fitted) or 'held_out' (the last part of each).
    """

    split: str
    declared: ErrorNorm
    recalibrated: ErrorNorm
    with_effects: ErrorNorm
    noise_floor: ErrorNorm


@dataclass(frozen=True)
class Horizon:
    """Errors of predictions so many seconds ahead, on held-out data, each where it ends.

    name: 'one step', '1 s', '5 s' or 'free-running'; seconds: None for free-running, which runs
    on to the end and counts all the way; count: how many predictions were pooled.
    """

    name: str
    seconds: float | None
    count: int
    declared: ErrorNorm
    recalibrated: ErrorNorm
    with_effects: ErrorNorm


@dataclass(frozen=True)
class Timing:
    """A run whose twists, or forces, are older than their stamps.

    lateness: by how much [s]; taken: what was done: 'pose', taken from the pose instead, and
    'smoothed', the same where they are not late; 'counts', as the means since the sample before
    that encoders' counts are; 'mean', as such for what they explain, and 'speed', the speeds
    alone; 'filter', as they were before a low-pass filter; 'undecided', as they are stamped,
    though means explain them as well; 'force', forces as having acted so long before their stamps.
    """

    run: str
    lateness: float
    taken: Literal['pose', 'smoothed', 'counts', 'mean', 'speed', 'filter', 'undecided', 'force']


@dataclass(frozen=True)
class Bias:
    """A run whose odometry turns while the robot stands.

    rate: how fast [rad/s]; so much was taken off all its turn rates.
    """

    run: str
    rate: float


@dataclass(frozen=True)
class Difference:
    """A parameter of which a run says something else than the other runs."""

    name: str
    here: Estimate
    others: Estimate


@dataclass(frozen=True)
class RunCheck:
    """One of several runs, held out in turn.

    error: free-running over the whole run, with parameters learned from the other runs alone;
    noise_floor: what white noise leaves of it. differences: beyond chance, the surest first; none
    where the run agrees. set_aside: whether nothing was learned from it, since it does not;
    own_effects: those that it shows by itself then, and the others deny. wheel_angles: where the
    right and the left wheel were taken to stand as it began [rad], 0 unless a ripple tells.
    """

    name: str
    error: ErrorNorm
    noise_floor: ErrorNorm
    differences: tuple[Difference, ...] = ()
    set_aside: bool = False
    own_effects: tuple[str, ...] = ()
    wheel_angles: tuple[float, float] = (0.0, 0.0)

    @property
    def agrees(self) -> bool:
        """Whether the other runs could be of the same robot in the same condition."""
        return not (self.differences or self.set_aside)


@dataclass(frozen=True)
class Comparison:
    """One held-out stretch: what was measured and what each model predicts, free-running.

    twist, pose: measured (pose None where none was recorded); the three trajectories are given
    at the same stamps. disturbance: the force [N] and torque [N·m] on the body, shape (k, 2),
    that the identified model still lacks, as estimated while predicting one step ahead.
    """

    run: str
    time: Array
    twist: Array
    pose: Array | None
    declared: Trajectory
    recalibrated: Trajectory
    with_effects: Trajectory
    disturbance: Array


@dataclass(frozen=True)
class Identification:
    """The whole answer.

    empirical: the table in `identified` that stands for what is unexplained, if it simulates
    better with it; timings: of runs whose twists were not taken as they were stamped; biases: of
    runs whose turn rates were not taken as they were told; near_rest: by how much a friction
    near rest of another form than declared, which was allowed for, lowers the deviance; 0 where
    nothing was; added_noise: what was added to twists that had none, None where nothing was;
    contradicted: declared effects that are not there as declared, so that the recalibrated model
    lacks them, and the identified one has them only where they are found, with other parameters;
    LAW among them where the generalized law of friction was taken in place of the declared one;
    nominal_beside: what the nominal parameters are beside the effects found, if any were.
    """

    verdict: str
    effects: tuple[FoundEffect, ...]
    unexplained: Structure | None
    nominal: dict[str, Estimate]
    errors: Errors
    candidates: tuple[Candidate, ...]
    declared: Model
    recalibrated: Model
    identified: Model
    comparisons: tuple[Comparison, ...]
    advice: tuple[str, ...] = ()
    empirical: Table | None = None
    horizons: tuple[Horizon, ...] = ()
    runs: tuple[RunCheck, ...] = ()
    timings: tuple[Timing, ...] = ()
    biases: tuple[Bias, ...] = ()
    near_rest: float = 0.0
    added_noise: ErrorNorm | None = None
    contradicted: tuple[str, ...] = ()
    nominal_beside: dict[str, Estimate] = field(default_factory=dict)
