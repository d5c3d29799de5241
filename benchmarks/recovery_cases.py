"""The cases that identification is judged on: families of robots, effects, sizes and floors."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, product
from typing import Any
from zlib import crc32

from peer_effects import EFFECTS, FOREIGN
from peer_manoeuvres import MANOEUVRES
from peer_robots import MAKES
from peer_sensors import SENSORS

# What is written down of a case that was judged.
Row = dict[str, Any]

FLOORS = ('smooth', 'rough')
# Effects that are asked with real sensors: those that slow odometry may hide or bring about.
SENSED = ('actuator_lag', 'actuator_delay', 'slope')
# Effects that are asked of wheels that creep: what acts at rest, and what does not; and how fast
# they creep [m/s].
AT_REST = ('slope', 'actuator_deadband', 'yaw_friction')
CREEP = (0.002, 0.005, 0.01)
# Effects that a controller which hears more may bring about.
LATE = ('actuator_lag', 'actuator_delay')
# Effects whose detection is followed over their size, in multiples of a weak one.
FOLLOWED = ('quadratic_drag', 'actuator_lag', 'wheel_friction_asymmetry', 'payload_change')
MULTIPLES = ('0.25×', '0.5×', '1×', '2×', '4×', '8×')


@dataclass(frozen=True)
class Case:
    """A robot with some effects of a size on a floor.

    removed: the library lacks them; drive: one of MANOEUVRES, or none: random drives take turns;
    sensors: one of SENSORS, or none: twists of the moment, with white noise; creep: how fast
    wheels do so below static friction [m/s]; heard: a controller that hears more than is recorded,
    on a floor whose memory is short.
    """

    family: str
    effects: tuple[str, ...]
    size: str
    make: str
    floor: str
    seed: int
    removed: bool = False
    drive: str = ''
    sensors: str = ''
    creep: float = 0.0
    heard: bool = False

    @property
    def name(self) -> str:
        """What tells it from all other cases."""
        effects = '+'.join(self.effects) or 'none'
        told = (self.family, effects, self.size, self.make, self.floor, str(self.seed))
        creep = f'creep {1e3 * self.creep:g} mm/s' if self.creep else ''
        return ' '.join(filter(None, (*told, self.drive, self.sensors, creep)))


def _clean(seed: int) -> Iterator[Case]:
    for make, floor in product(MAKES, FLOORS):
        yield Case('clean', (), '-', make, floor, seed)


def _single(seed: int) -> Iterator[Case]:
    for name, size, floor in product(EFFECTS, ('typical', 'weak'), FLOORS):
        yield Case('single', (name,), size, _make(seed), floor, seed)


def _pairs(seed: int) -> Iterator[Case]:
    for pair, floor in product(combinations(EFFECTS, 2), FLOORS):
        yield Case('pairs', pair, 'typical', _make(seed), floor, seed)


def _removed(seed: int) -> Iterator[Case]:
    for name, floor in product(EFFECTS, FLOORS):
        yield Case('removed', (name,), 'typical', _make(seed), floor, seed, removed=True)


def _foreign(seed: int) -> Iterator[Case]:
    for name, floor in product(FOREIGN, FLOORS):
        yield Case('foreign', (name,), 'typical', _make(seed), floor, seed)


def _sizes(seed: int) -> Iterator[Case]:
    for name, size, floor in product(FOLLOWED, MULTIPLES, FLOORS):
        yield Case('sizes', (name,), size, _make(seed), floor, seed)


def _drives(seed: int) -> Iterator[Case]:
    for drive, effects in product(MANOEUVRES, _none_or_one(EFFECTS)):
        yield Case('drives', effects, 'typical', 'medium', 'smooth', seed, drive=drive)
    for drive, effects in product(('stairs', 'keyboard'), _none_or_one(EFFECTS)):
        yield Case('drives', effects, 'typical', 'large', 'rough', seed, drive=drive)


def _odometry(seed: int) -> Iterator[Case]:
    """Yield clean robots, and ones with an effect, each with the sensors whose turn it is."""
    for turn, (effects, make, floor) in _in_turn(SENSED, seed):
        sensors = tuple(SENSORS)[(turn + 1) % len(SENSORS)]
        yield Case('odometry', effects, 'typical', make, floor, turn + 1, sensors=sensors)


def _creeping(seed: int) -> Iterator[Case]:
    """Yield clean robots, and ones with an effect, whose wheels creep at a speed in turn."""
    for turn, (effects, make, floor) in _in_turn(AT_REST, seed):
        creep = CREEP[(turn // 2 + turn // 6) % len(CREEP)]
        yield Case('creeping', effects, 'typical', make, floor, turn, creep=creep)


def _heard(seed: int) -> Iterator[Case]:
    """Yield clean robots, and late ones, under a controller that hears more than is recorded."""
    for turn, (effects, make, floor) in _in_turn(LATE, seed):
        yield Case('heard', effects, 'typical', make, floor, turn, heard=True)


FAMILIES: dict[str, Callable[[int], Iterator[Case]]] = {
    'clean': _clean,
    'single': _single,
    'pairs': _pairs,
    'removed': _removed,
    'foreign': _foreign,
    'sizes': _sizes,
    'drives': _drives,
    'odometry': _odometry,
    'creeping': _creeping,
    'heard': _heard,
}


def cases(families: Sequence[str], seeds: range, share: float) -> Iterator[Case]:
    """List the cases of families, seed by seed; of a share, always the same ones."""
    for seed, family in product(seeds, families):
        for case in FAMILIES[family](seed):
            if crc32(case.name.encode()) / 2**32 < share:
                yield case


def _in_turn(
    names: Iterable[str], seed: int
) -> Iterator[tuple[int, tuple[tuple[str, ...], str, str]]]:
    """Number robots of all makes and floors, clean or with one effect, on from the last round."""
    robots = list(product(_none_or_one(names), MAKES, FLOORS))
    return enumerate(robots, start=seed * len(robots))


def _none_or_one(names: Iterable[str]) -> list[tuple[str, ...]]:
    """Return the effects of a clean robot, and of robots that have one."""
    return [(), *((name,) for name in names)]


def _make(seed: int) -> str:
    """Return the robot whose turn it is."""
    return tuple(MAKES)[seed % len(MAKES)]
