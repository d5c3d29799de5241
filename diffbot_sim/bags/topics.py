"""Which topics of a bag hold one robot's forces and odometry."""

from collections.abc import Collection, Container, Iterable, Mapping
from dataclasses import dataclass, fields

from diffbot_sim.bags.messages import ODOMETRY, WRENCH
from diffbot_sim.errors import BagError

# Relative names for each role, the better one first.
NAMES = {
    'left_force': ('left_wheel/force', 'left_wheel/force_cmd'),
    'right_force': ('right_wheel/force', 'right_wheel/force_cmd'),
    'odom': ('odom',),
}
TYPES = {'left_force': WRENCH, 'right_force': WRENCH, 'odom': ODOMETRY}
MEANING = {
    'left_force': 'force of the left wheel',
    'right_force': 'force of the right wheel',
    'odom': 'odometry',
}


@dataclass(frozen=True)
class Topics:
    """Names of the topics to read; None where the usual names are looked for."""

    left_force: str | None = None
    right_force: str | None = None
    odom: str | None = None

    def __post_init__(self) -> None:
        for role, name in self.named().items():
            object.__setattr__(self, role, absolute(name))

    def named(self) -> dict[str, str]:
        """Return the names that are not None, by role."""
        names = {item.name: getattr(self, item.name) for item in fields(self)}
        return {role: name for role, name in names.items() if name is not None}


def absolute(name: str) -> str:
    """Return a topic's full name; not every writer of bags puts the slash before it."""
    return '/' + name.strip('/')


def find_topics(there: Mapping[str, str], given: Topics) -> dict[str, str]:
    """Return the topic for each role: the given ones, the others from one robot's namespace.

    there: types by the full names of topics that hold messages. Raises BagError when the topics of
    one robot are not found, when there are several robots, or when a type is wrong.
    """
    robots = {name: _robot(name, there, given).named() for name in _namespaces(there)}
    whole = {name: topics for name, topics in robots.items() if len(topics) == len(NAMES)}
    found = list(whole.values())
    if not found:
        raise BagError(_missing(list(robots.values()), there))
    if any(topics != found[0] for topics in found):
        raise BagError(
            f'several robots: {", ".join(name or "/" for name in whole)}. '
            'Name the topics of one with --left-force, --right-force and --odom.'
        )
    _check_topics(found[0], there)
    return found[0]


def wheel_forces(there: Collection[str]) -> list[str]:
    """Return the topics of the forces of all robots' wheels, the better one of each wheel."""
    robots = [_robot(namespace, there, Topics()) for namespace in _namespaces(there)]
    both = (side for robot in robots for side in (robot.left_force, robot.right_force))
    return [topic for topic in both if topic is not None]


def _namespaces(there: Iterable[str]) -> list[str]:
    """List what stands before the usual names, and '' (no namespace) in any case."""
    usual = [f'/{name}' for names in NAMES.values() for name in names]
    found = {topic.removesuffix(end) for topic in there for end in usual if topic.endswith(end)}
    return sorted(found | {''})


def _robot(namespace: str, there: Container[str], given: Topics) -> Topics:
    usual = {
        role: next((topic for name in names if (topic := f'{namespace}/{name}') in there), None)
        for role, names in NAMES.items()
    }
    return Topics(**(usual | given.named()))


def _missing(robots: list[dict[str, str]], there: Mapping[str, str]) -> str:
    nowhere = [role for role in NAMES if not any(role in topics for topics in robots)]
    what = ' and no '.join(MEANING[role] for role in nowhere)
    fault = f'no {what}' if nowhere else 'forces and odometry are in different namespaces'
    options = ', '.join('--' + role.replace('_', '-') for role in nowhere or NAMES)
    return f'{fault}. Name the topics with {options}. {_inventory(there)}'


def _check_topics(topics: Mapping[str, str], there: Mapping[str, str]) -> None:
    if topics['left_force'] == topics['right_force']:
        raise BagError(
            f'{topics["left_force"]} is given for both wheels. Name the topic of each with '
            '--left-force and --right-force.'
        )
    for role, topic in topics.items():
        if topic not in there:
            raise BagError(f'no messages on {topic}. {_inventory(there)}')
        if there[topic] != TYPES[role]:
            raise BagError(
                f'{topic} holds {there[topic]}; the {MEANING[role]} must be {TYPES[role]}.'
            )


def _inventory(there: Mapping[str, str]) -> str:
    listed = ', '.join(f'{topic} ({kind})' for topic, kind in sorted(there.items()))
    return f'The bag holds {listed}.' if listed else 'The bag holds no messages.'
