"""ROS parameters declared, checked and kept from the same fields as the YAML."""

import sys
from collections.abc import Callable, Iterable, Mapping
from dataclasses import fields, is_dataclass
from itertools import takewhile
from typing import Any, Generic, TypeVar

from rcl_interfaces.msg import (
    FloatingPointRange,
    IntegerRange,
    ParameterDescriptor,
    SetParametersResult,
)
from rclpy.exceptions import ParameterNotDeclaredException
from rclpy.node import Node
from rclpy.parameter import Parameter

from diffbot_sim.config import model_from_mapping
from diffbot_sim.errors import ConfigError
from diffbot_sim.nodes import settings
from diffbot_sim.parameters import Spec, specs, suggestion
from diffbot_sim.physics import Friction, Model, Robot
from diffbot_sim.physics.effects import library

Values = Mapping[str, Any]
Result = TypeVar('Result')

SECTIONS = ('robot.', 'friction.', 'effects.')
# Every node has these from rclpy.
COMMON = ('use_sim_time', 'start_type_description_service')
QOS_OVERRIDES = 'qos_overrides.'


def table(kind: Any, prefix: str = '') -> dict[str, Spec]:
    """List the parameters of a dataclass and of the dataclasses in it, by dotted name."""
    own = {prefix + spec.name: spec for spec in specs(kind)}
    for item in fields(kind):
        if is_dataclass(item.default):
            own |= table(item.default, f'{prefix}{item.name}.')
    return own


def build(kind: Callable[..., Result], values: Values, prefix: str = '') -> Result:
    """Build a dataclass, and the dataclasses in it, from values by dotted name."""
    parts: dict[str, Any] = {}
    for item in fields(kind):  # type: ignore[arg-type]
        name = prefix + item.name
        if is_dataclass(item.default):
            parts[item.name] = build(type(item.default), values, name + '.')
        else:
            parts[item.name] = values[name]
    return kind(**parts)


def model_table() -> dict[str, Spec]:
    """List the parameters of the robot, its friction and every known effect."""
    listed = table(Robot, 'robot.') | table(Friction, 'friction.')
    for name, kind in library().items():
        listed |= table(kind, f'effects.{name}.')
    return listed


def build_model(values: Values, on: Iterable[str] = ()) -> Model:
    """Build a model; an effect is in it when named in `on` or away from its neutral values.

    Raises ConfigError when the values contradict each other.
    """
    effects = {name: build(kind, values, f'effects.{name}.') for name, kind in library().items()}
    return Model(
        build(Robot, values, 'robot.'),
        build(Friction, values, 'friction.'),
        tuple(e for name, e in effects.items() if name in on or e != library()[name]()),
    )


def given(node: Node) -> dict[str, Any]:
    """Return what files and command line set, by name; raises ConfigError at unknown names."""
    # rclpy ignores what nobody declares and tells nobody; this is where it keeps it.
    overrides = node._parameter_overrides.items()
    values = {name: item.value for name, item in overrides if item.value is not None}
    names = [*COMMON, *(name for kind in settings.ALL for name in table(kind))]
    known = [name for name in names if not name.startswith(SECTIONS)]
    for name in values:
        if name not in known and not name.startswith((*SECTIONS, QOS_OVERRIDES)):
            raise ConfigError(
                f'{node.get_name()}: {name}: unknown parameter. {suggestion(name, known)}'
            )
    model_from_mapping(nested(values), node.get_name())
    return values


def listed_effects(node: Node) -> set[str]:
    """Name the effects that files and command line mention, even if only to be tuned later."""
    return {name.split('.')[1] for name in given(node) if name.startswith('effects.')}


class UnknownParameterError(ParameterNotDeclaredException):
    """Takes the place of rclpy's own, which forgets to say the name."""

    def __init__(self, name: str, known: Iterable[str]) -> None:
        part, names = beside(name, known)
        Exception.__init__(self, f'{name}: unknown parameter. {suggestion(part, names)}')


def beside(name: str, known: Iterable[str]) -> tuple[str, list[str]]:
    """Return the first part of a dotted name that is unknown, and what is known in its place."""
    paths, path = [item.split('.') for item in known], name.split('.')
    depth = min(max(_shared(path, other) for other in paths), len(path) - 1)
    place = [other[: depth + 1] for other in paths if other[:depth] == path[:depth]]
    return '.'.join(path[: depth + 1]), list(dict.fromkeys(map('.'.join, place)))


def _shared(path: list[str], other: list[str]) -> int:
    """Count the parts that two names begin with alike."""
    alike = takewhile(lambda pair: pair[0] == pair[1], zip(path, other, strict=False))
    return len(list(alike))


class Live(Generic[Result]):
    """Parameters that can change while a node runs.

    known: all of them. make: builds what the node works with from all values, without side
    effects, or raises ConfigError; a change is refused with its message. fixed: those that do not
    change. apply: called with the new result afterwards. Raises ConfigError when the start values
    are wrong.
    """

    def __init__(
        self,
        node: Node,
        known: Mapping[str, Spec],
        make: Callable[[Values], Result],
        fixed: Iterable[str],
        apply: Callable[[Result], None] = lambda result: None,
    ) -> None:
        self._node, self._known, self._make, self._apply = node, known, make, apply
        start = {name: value for name, value in given(node).items() if name in known}
        defaults = {name: spec.default for name, spec in known.items()}
        self._values = self._checked({**defaults, **start}, f'{node.get_name()}: ')
        self.value = make(self._values)
        for name, value in self._values.items():
            about = descriptor(known[name], name in fixed)
            node.declare_parameter(name, value, about, ignore_override=True)
        node.add_pre_set_parameters_callback(self._before)
        node.add_on_set_parameters_callback(self._check)
        node.add_post_set_parameters_callback(self._after)

    def _before(self, changes: list[Parameter]) -> list[Parameter]:
        """Turn `10` into `10.0` where a double is declared; rclpy alone would refuse it.

        Raises what rclpy makes the answer where a parameter is unknown.
        """
        for item in changes:
            if not self._node.has_parameter(item.name):
                raise UnknownParameterError(item.name, self._known)
        return [
            Parameter(item.name, value=converted(self._known[item.name], item.value))
            if item.name in self._known
            else item
            for item in changes
        ]

    def _check(self, changes: list[Parameter]) -> SetParametersResult:
        try:
            self._make({**self._values, **self._checked(self._ours(changes))})
        except ConfigError as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def _after(self, changes: list[Parameter]) -> None:
        if ours := self._ours(changes):
            self._values = {**self._values, **ours}
            self.value = self._make(self._values)
            self._apply(self.value)

    def _ours(self, changes: list[Parameter]) -> dict[str, Any]:
        return {item.name: item.value for item in changes if item.name in self._known}

    def _checked(self, values: Values, where: str = '') -> dict[str, Any]:
        faults = [
            f'{name}: {fault}'
            for name, value in values.items()
            if (fault := fault_of(self._known[name], value))
        ]
        if faults:
            raise ConfigError(where + '; '.join(faults))
        return {name: converted(self._known[name], value) for name, value in values.items()}


def fault_of(spec: Spec, value: object) -> str | None:
    """Say what is wrong with a value of any parameter type, or None."""
    kind = type(spec.default)
    if kind is float or spec.choices:
        return spec.fault(value)
    if kind is tuple:
        fits = isinstance(value, (list, tuple)) and all(isinstance(v, str) for v in value)
    else:
        fits = type(value) is kind
    if not fits:
        return f'{value!r} is not valid; {spec.name} ({spec.meaning}) takes {WORDS[kind]}'
    return spec.fault(value) if kind is int else None


WORDS = {bool: 'true or false', int: 'an integer', str: 'a text', tuple: 'a list of texts'}


def converted(spec: Spec, value: Any) -> Any:
    """Return an integer as float where a float is wanted, everything else as it is."""
    return float(value) if type(value) is int and type(spec.default) is float else value


def descriptor(spec: Spec, read_only: bool) -> ParameterDescriptor:
    """Describe a parameter to `ros2 param describe` and to rqt."""
    about = ParameterDescriptor(
        description=f'{spec.meaning} [{spec.unit_text}]' if spec.unit_text else spec.meaning,
        additional_constraints=spec.valid if spec.choices else '',
        read_only=read_only,
    )
    if type(spec.default) is float:
        ends = (max(spec.low, -sys.float_info.max), min(spec.high, sys.float_info.max))
        about.floating_point_range = [FloatingPointRange(from_value=ends[0], to_value=ends[1])]
    elif type(spec.default) is int:
        about.integer_range = [IntegerRange(from_value=int(spec.low), to_value=int(spec.high))]
    return about


def nested(values: Values) -> dict[str, Any]:
    """Return dotted names as nested mappings; raises ConfigError where one is both."""
    tree: dict[str, Any] = {}
    for name in sorted(values, key=lambda name: name.count('.')):
        *path, last = name.split('.')
        branch = tree
        for key in path:
            branch = branch.setdefault(key, {})
            if not isinstance(branch, dict):
                raise ConfigError(f"{name}: '{key}' is a value already. Remove one of them.")
        branch[last] = values[name]
    return tree
