"""What is driven: wheel forces drawn at random, or prescribed in segments."""

from dataclasses import dataclass, field

import numpy as np

from diffbot_sim.errors import ConfigError
from diffbot_sim.parameters import parameter
from diffbot_sim.records import Array, Commands

# Random forces change at multiples of 1/GRID seconds [Hz].
GRID = 50.0


def stamps(duration: float, rate: float) -> Array:
    """Return the multiples of 1/rate [Hz] from 0 up to, not including, a duration [s].

    Equal moments of two rates have equal bits.
    """
    time = np.arange(int(duration * rate) + 1) / rate
    return time[time < duration]


@dataclass(frozen=True)
class RandomForces:
    """Wheel forces that are drawn anew after random times.

    Raises ConfigError when bounds or shares contradict each other.
    """

    duration: float = parameter(60.0, unit='s', low=0.1, high=1e4, meaning='length of a run')
    least: float = parameter(-10.0, unit='N', low=-1e5, high=1e5, meaning='least force on a wheel')
    most: float = parameter(10.0, unit='N', low=-1e5, high=1e5, meaning='greatest force')
    shortest: float = parameter(
        0.5, unit='s', low=0.0, high=1e4, meaning='shortest time for which forces are held'
    )
    longest: float = parameter(2.4, unit='s', low=0.0, high=1e4, meaning='longest such time')
    straight: float = parameter(
        0.4, low=0.0, high=1.0, meaning='share of holds with equal force on both wheels'
    )
    stops: float = parameter(0.15, low=0.0, high=1.0, meaning='share of holds without force')

    def __post_init__(self) -> None:
        for low, high in (('least', 'most'), ('shortest', 'longest')):
            below, above = getattr(self, low), getattr(self, high)
            if below > above:
                raise ConfigError(
                    f'random.{low}: {below:g} exceeds random.{high} {above:g}. '
                    f'Lower {low} or raise {high}.'
                )
        if self.straight + self.stops > 1.0:
            raise ConfigError(
                f'random.straight: {self.straight:g} and random.stops {self.stops:g} '
                'are shares of one whole. Lower them until their sum is at most 1.'
            )

    def commands(self, seed: int) -> Commands:
        """Draw the forces of a run; the same seed gives the same bits."""
        random = np.random.default_rng(seed)
        time = stamps(self.duration, GRID)
        force = np.zeros((len(time), 2))
        begin = 0
        while begin < len(time):
            end = begin + max(1, int(GRID * random.uniform(self.shortest, self.longest)))
            wheels, kind = random.uniform(self.least, self.most, 2), random.random()
            if kind < self.straight:
                wheels[1] = wheels[0]
            force[begin:end] = 0.0 if kind > 1.0 - self.stops else wheels
            begin = end
        return Commands(time, force)


@dataclass(frozen=True)
class Segment:
    """Wheel forces that are held from the end of the segment before."""

    until: float = parameter(
        0.0, unit='s', low=0.0, high=1e4, meaning='end of the segment, from the start of the run'
    )
    right: float = parameter(0.0, unit='N', low=-1e5, high=1e5, meaning='force on the right wheel')
    left: float = parameter(0.0, unit='N', low=-1e5, high=1e5, meaning='force on the left wheel')


@dataclass(frozen=True)
class SegmentForces:
    """Prescribed wheel forces.

    Raises ConfigError when there is no segment, or one that does not end after the one before.
    """

    segments: tuple[Segment, ...]

    def __post_init__(self) -> None:
        if not self.segments:
            raise ConfigError('segments: there is none. Give at least one.')
        begin = 0.0
        for i, segment in enumerate(self.segments):
            if segment.until <= begin:
                raise ConfigError(
                    f'segments[{i}].until: {segment.until:g} s is not after {begin:g} s, '
                    'where the segment begins. Put the segments in order of time.'
                )
            begin = segment.until

    @property
    def duration(self) -> float:
        """The end of the last segment [s]."""
        return self.segments[-1].until

    def commands(self, seed: int) -> Commands:
        """Return the forces, which are the same for every seed."""
        del seed
        begins = [0.0, *(segment.until for segment in self.segments[:-1])]
        forces = [(segment.right, segment.left) for segment in self.segments]
        return Commands(np.array(begins), np.array(forces))


Forces = RandomForces | SegmentForces


@dataclass(frozen=True)
class Drive:
    """Forces, and how often the motion is written down; the rate does not change the motion."""

    forces: Forces = field(default_factory=RandomForces)
    rate: float = parameter(
        50.0, unit='Hz', low=0.1, high=1e3, meaning='rows of the table in a second'
    )

    def commands(self, seed: int) -> Commands:
        """Return the forces of a run, after a second without any, so that actuators are at rest.

        Otherwise the first force would count as having acted for long.
        """
        drawn = self.forces.commands(seed)
        return Commands(
            np.concatenate([[-1.0], drawn.time]), np.concatenate([np.zeros((1, 2)), drawn.force])
        )

    @property
    def times(self) -> Array:
        """The stamps of the rows [s]."""
        return stamps(self.forces.duration, self.rate)
