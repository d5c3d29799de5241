"""The floors of the house: imports point down, and each foreign package has its room."""

import ast
import re
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PACKAGE = 'diffbot_sim'
FUNCTION = ast.FunctionDef | ast.AsyncFunctionDef

FLOORS = {
    1: {'records', 'parameters', 'errors', 'files', 'standing'},
    2: {'physics', 'drives'},
    3: {'control', 'bags', 'tables', 'config'},
    4: {'identification', 'paper'},
    5: {'report'},
    6: {'nodes', 'commands', '__main__', 'entry_points'},
}
FLOOR = {room: floor for floor, rooms in FLOORS.items() for room in rooms}
OPEN_FLOORS = {1, 6}  # their rooms may import each other

# The floors inside identification, from the ground up.
STOREYS: list[set[str]] = [
    {'result'},
    {'statistics'},
    {'recordings'},
    {'fitting'},
    {'selection'},
    {'free_forms', 'conclusions', 'suspicion', 'found', 'leading'},
    {'doubt', 'following', 'older', 'odd_ones', 'later'},
    {'allowing', 'simulating', 'standing_wheels', 'contradiction'},
    {'finding'},
    {'retimed'},
    {'search'},
    {'questioning'},
    {'identify'},
]
STOREY = {chamber: storey for storey, chambers in enumerate(STOREYS) for chamber in chambers}

PLOTTING = {'report', 'paper'}
HOME = {
    'rclpy': {'nodes'},
    'rosbags': {'bags'},
    'pyarrow': {'tables'},
    'mcap': {'bags'},
    'yaml': {'config', 'bags'},
    'scipy': {room for room, floor in FLOOR.items() if floor >= FLOOR['identification']},
    'matplotlib': PLOTTING,
    'plotly': PLOTTING,
    'jinja2': PLOTTING,
}


@dataclass(frozen=True)
class Arrow:
    """One import: who imports what, and whether it happens as soon as the module loads."""

    source: str
    target: str
    at_load: bool = True

    @property
    def is_own(self) -> bool:
        return self.target.split('.')[0] == PACKAGE


def room_of(module: str) -> str:
    """Name the room of a module; '' for the package itself."""
    return f'{module}..'.split('.')[1]


def chamber_of(module: str) -> str:
    """Name the room inside a room; '' for the package of that room itself."""
    return f'{module}...'.split('.')[2]


def module_of(path: Path) -> str:
    parts = path.relative_to(ROOT).with_suffix('').parts
    return '.'.join(parts[:-1] if parts[-1] == '__init__' else parts)


def targets(node: ast.AST, package: str) -> list[str]:
    """Name what an import statement imports, relative ones made absolute."""
    if isinstance(node, ast.Import):
        return [alias.name for alias in node.names]
    if not isinstance(node, ast.ImportFrom):
        return []
    module = node.module or ''
    if node.level:
        module = '.'.join(filter(None, (package.rsplit('.', node.level - 1)[0], module)))
    return [f'{module}.{alias.name}' for alias in node.names] if module == PACKAGE else [module]


def arrows_in(text: str, module: str, package: str) -> Iterator[Arrow]:
    tree = ast.parse(text)
    functions = [n for n in ast.walk(tree) if isinstance(n, FUNCTION)]
    lazy = {id(node) for function in functions for node in ast.walk(function)}
    for node in ast.walk(tree):
        for target in targets(node, package):
            yield Arrow(module, target, at_load=id(node) not in lazy)


def arrows_of(path: Path) -> Iterator[Arrow]:
    module = module_of(path)
    package = module if path.name == '__init__.py' else module.rpartition('.')[0]
    return arrows_in(path.read_text(encoding='utf-8'), module, package)


def fault(arrow: Arrow) -> str | None:
    """Say what is wrong with an import, or None."""
    return _fault_inside(arrow) if arrow.is_own else _fault_outside(arrow)


def _fault_inside(arrow: Arrow) -> str | None:
    source, target = room_of(arrow.source), room_of(arrow.target)
    if source == target == 'identification':
        return _fault_in_identification(arrow)
    if source == target or target not in FLOOR:
        return None
    here, there = FLOOR.get(source, 0), FLOOR[target]
    if there > here or (there == here and here not in OPEN_FLOORS):
        return f'{arrow.source} (floor {here}) imports {arrow.target} (floor {there})'
    if (source, target) == ('identification', 'bags'):
        return f'{arrow.source} imports {arrow.target}: identification sees runs, never a bag'
    if target == 'nodes' and arrow.at_load and arrow.source != f'{PACKAGE}.commands.demo':
        return f'{arrow.source} imports {arrow.target} at load: offline tools need no rclpy'
    return None


def _fault_in_identification(arrow: Arrow) -> str | None:
    source, target = chamber_of(arrow.source), chamber_of(arrow.target)
    if not source or source == target or STOREY[source] > STOREY[target]:
        return None
    return f'{arrow.source} (storey {STOREY[source]}) imports {arrow.target}, which is not below'


def _fault_outside(arrow: Arrow) -> str | None:
    name = arrow.target.split('.')[0]
    name = 'rclpy' if name.endswith(('_msgs', '_srvs', '_interfaces')) else name
    rooms = HOME.get(name)
    if rooms is None or room_of(arrow.source) in rooms:
        return None
    return f'{arrow.source} imports {arrow.target}, which belongs in {", ".join(sorted(rooms))}'


def modules() -> list[Path]:
    return sorted((ROOT / PACKAGE).rglob('*.py'))


def test_every_module_has_a_floor() -> None:
    rooms = {room_of(module_of(path)) for path in modules()} - {''}
    assert rooms <= FLOOR.keys()
    inside = {chamber_of(module_of(path)) for path in modules() if 'identification' in path.parts}
    assert inside - {''} == STOREY.keys()


def test_imports_point_down_and_foreign_packages_stay_home() -> None:
    found = [fault(arrow) for path in modules() for arrow in arrows_of(path)]
    assert not list(filter(None, found))


@pytest.mark.parametrize(
    ('module', 'text', 'message'),
    [
        ('physics.model', 'import diffbot_sim.report.text', r'floor 2.*floor 5'),
        ('physics.model', 'from ..report import text', r'floor 2.*floor 5'),
        ('physics.model', 'from diffbot_sim import report', r'floor 2.*floor 5'),
        ('physics.model', 'def late():\n    import diffbot_sim.report', r'floor 2.*floor 5'),
        ('control.pi', 'from diffbot_sim.bags import read', r'floor 3.*floor 3'),
        ('identification.fit', 'from diffbot_sim.bags import read', r'never a bag'),
        ('identification.fitting.fit', 'from ..doubt import doubt', r'storey 3.*not below'),
        ('commands.simulate', 'from diffbot_sim.nodes import replay', r'need no rclpy'),
        ('commands.simulate', 'from geometry_msgs.msg import Twist', r'belongs in nodes'),
        ('physics.model', 'from scipy import optimize', r'belongs in .*identification'),
    ],
)
def test_a_wrong_import_is_found(module: str, text: str, message: str) -> None:
    source = f'{PACKAGE}.{module}'
    (arrow,) = arrows_in(text, source, source.rpartition('.')[0])
    assert re.search(message, fault(arrow) or 'no fault')


@pytest.mark.parametrize(
    ('module', 'text'),
    [
        ('report.text', 'from diffbot_sim.identification import result'),
        ('physics.model', 'from .effects import slope'),
        ('commands.simulate', 'from diffbot_sim.errors import DiffbotError'),
        ('commands.demo', 'from diffbot_sim.nodes import replay'),
        ('__main__', 'def main():\n    from diffbot_sim.nodes import replay'),
        ('nodes.simulator', 'import rclpy'),
        ('physics.model', 'from diffbot_sim import __version__'),
    ],
)
def test_a_right_import_passes(module: str, text: str) -> None:
    source = f'{PACKAGE}.{module}'
    (arrow,) = arrows_in(text, source, source.rpartition('.')[0])
    assert fault(arrow) is None


OFFLINE = [
    module_of(path) for path in modules() if path.parent.name == 'commands' and path.stem != 'demo'
]


@pytest.mark.parametrize('module', [f'{PACKAGE}.__main__', *OFFLINE])
def test_offline_tools_load_without_rclpy(module: str) -> None:
    code = f'import sys, {module}; sys.exit("rclpy" in sys.modules)'
    assert subprocess.run([sys.executable, '-c', code], cwd=ROOT, check=False).returncode == 0
