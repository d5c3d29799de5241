"""What the answer takes for granted: a reader who knows better knows what not to believe."""

from collections.abc import Sequence

from diffbot_sim.identification.conclusions import agreement
from diffbot_sim.identification.recordings import stretches
from diffbot_sim.identification.recordings.intervals import median_interval
from diffbot_sim.identification.result import Identification
from diffbot_sim.identification.statistics import guards
from diffbot_sim.physics.effects.slope import STANDARD_GRAVITY
from diffbot_sim.report.numerals import significant
from diffbot_sim.report.remarks import remarks
from diffbot_sim.report.sentences import split


def assumptions(result: Identification, notes: Sequence[str]) -> list[str]:
    """List what was assumed about the robot, the recording and the decisions.

    notes: what was noticed while the recording was read.
    """
    return [*_robot(result), *_recording(result, notes), *_errors(result), *_decisions()]


def _robot(result: Identification) -> list[str]:
    robot = result.declared.robot
    return [
        'Wheels roll without slipping, and all runs are of one robot in one condition.',
        f'Wheel separation {robot.wheel_separation:g} m, unless effective_track is named, and '
        f'radius {robot.wheel_radius:g} m are as declared; odometry was made with the same.',
        'The floor is flat, or tilted evenly. What else it does (bumps, joints) is a force that '
        'may be correlated in time, so that it does not pass for an effect.',
    ]


def _recording(result: Identification, notes: Sequence[str]) -> list[str]:
    rates = [1.0 / median_interval(run.time) for run in result.comparisons]
    at = f' It was used at {_listed(rates)} Hz.' if rates else ''
    return [
        'The recorded forces are those that were asked of the actuators, without error, each '
        'held until the next one.',
        'Forces and odometry are stamped by one clock, when they were measured; time counts from '
        'the start of each run.',
        *notes,
        *remarks(result),
        f'Odometry faster than {stretches.HIGHEST_RATE:g} Hz is averaged down.{at}',
        f'Left out as start-up: the first {stretches.SETTLING:g} s of what was fitted.',
    ]


def _errors(result: Identification) -> list[str]:
    return [
        f'Errors are those of free-running simulation {split(result.errors)}: driven by the '
        'recorded forces alone, never corrected on the way. Pose and rest are as measured at the '
        'start; a robot in motion begins with the speeds that fit the first second best.',
        'The noise floor is the error that a perfect model would still have: '
        'measurement noise, taken as white, or the steps of a coarse encoder.',
        'Intervals are 95 % intervals, each for its parameter alone; at a bound they mean little.',
        f'Gravity is {STANDARD_GRAVITY} m/s².',
    ]


def _decisions() -> list[str]:
    return [
        'An effect enters when three tests agree: likelihood ratio '
        f'(p < {guards.LIKELIHOOD_LEVEL:g}, corrected for the number of effects tried), the '
        'same against serial correlation, and a gain on data that it was not fitted to (neither '
        f'p above {guards.EITHER_LEVEL:g}, both together p < {guards.BOTH_LEVEL:.2g}).',
        'Effects were chosen with all fitted runs, but for those set aside: of these each by '
        'itself, and all others together, leave nothing unexplained, but all together do. '
        'A run disagrees when a parameter differs from '
        f'that of the others (p < {agreement.LEVEL:g}, corrected for runs and parameters) by more '
        f'than {100 * agreement.IMMATERIAL:g} %.',
    ]


def _listed(rates: list[float]) -> str:
    return ', '.join(sorted({significant(rate, 2) for rate in rates}, key=float))
