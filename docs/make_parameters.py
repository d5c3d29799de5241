"""Writes parameters.md from the declarations in the code: python docs/make_parameters.py."""

from collections.abc import Iterable, Iterator
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Any

from diffbot_sim.nodes import settings
from diffbot_sim.parameters import Spec, specs
from diffbot_sim.physics import Friction, Robot
from diffbot_sim.physics.effects import Effect, library

TARGET = Path(__file__).with_name('parameters.md')
HEAD = """# All parameters

Written by `python docs/make_parameters.py` from the declarations in the code. A nested name like
`pi.kp` is a nested mapping in YAML. *Live* ones can be changed while the node runs:
`ros2 param set /simulator robot.mass 12.0`. What is not valid is refused with the reason.
"""
NODES = {
    'simulator': settings.SimulatorSettings,
    'pi_controller': settings.ControllerSettings,
    'recorder': settings.RecorderSettings,
    'driver': settings.DriverSettings,
}
BELONG = {
    'simulator': 'Those of `robot`, `friction` and `effects` below belong to it, too. *Live.*',
    'pi_controller': 'Those of `robot` and `friction` below belong to it, too. *Live.*',
}
ROBOT = """\
Odometry tells of the point between the wheels. The centre of gravity is there, too, unless
`com_offset` moves it; the inertia is about the centre of gravity. Both hold what turns with the
wheels: a wheel with its gears and rotor, of moment of inertia I about the axle, adds I/r² to the
mass and I·b²/r² to the inertia.
"""
FRICTION = """\
**Law** of each wheel, eqs. (12) and (13) of the paper, with F_s, F_k, F_v = μ_s, μ_k, μ_v times
F_N: rolling at v it is sgn(v)·(F_k + (F_s - F_k)·exp(-a_st·|v|)) + F_v·v; at rest it holds
whatever pushes, up to F_s. The models leave out parts:

| model | at rest, up to | rolling |
|---|---|---|
| none | 0 | 0 |
| coulomb | F_k | F_k |
| coulomb_stiction | F_s | F_k |
| coulomb_viscous | F_k | F_k + F_v·v |
| generalized | F_s | the whole law |

What a model leaves out may stay out of the file, too; where both are used μ_k may not exceed μ_s.
"""
EFFECTS = """\
One that is absent is off. Each lives in a file of its own. They are listed in the order in which
they act: on the command, on the force of the motors, on its way to the wheels, on the friction of
each wheel, on the body, on its inertia. The dry friction that some change is F_s and F_k alike; a
wheel at rest has that of the direction in which it would start. Where several change the friction
of a wheel their factors multiply; none changes F_N, so that a slope leaves friction as it is.
*Rounded* is a force f that a limit L turns into f / (1 + (|f|/L)^n)^(1/n): n is 128 for
`voltage_limit`, so that 0.5 % are missing at the limit, and hypot(12, v / (1 cm/s)) for
`power_limit`. Time counts from the first message of a run, be it force or odometry; before the
first force none acts.
"""


def page() -> str:
    """Return the whole page."""
    parts = [HEAD]
    for name, kind in NODES.items():
        about = (kind.__doc__ or '').partition('\n')[0]
        parts += [
            f'## `{name}`\n',
            about + '\n',
            *([BELONG[name] + '\n'] if name in BELONG else []),
        ]
        rows = list(_flat(kind))
        fixed = getattr(kind, 'fixed', [row[0] for row in rows])
        parts.append(_table(rows, fixed))
    parts += ['## `robot`\n', ROBOT, _table(_named(Robot, 'robot.'))]
    parts += ['## `friction`\n', FRICTION, _table(_named(Friction, 'friction.'))]
    parts += ['## `effects`\n', EFFECTS]
    parts += [part for effect in library().values() for part in _effect(effect)]
    return '\n'.join(parts)


def _effect(kind: type[Effect]) -> Iterator[str]:
    yield f'### `{kind.name}`\n'
    meaning = kind.meaning[0].upper() + kind.meaning[1:]
    law = ' '.join((kind.__doc__ or '').split())
    sought = '' if kind.is_sought else ' Only simulated: `identify` does not look for it.'
    yield f'{meaning}. **Law:** {law} Source: {kind.source}. Shown by {kind.excitation}.{sought}\n'
    yield _table(_named(kind, f'effects.{kind.name}.'))


def _flat(kind: Any, prefix: str = '') -> Iterator[tuple[str, Spec]]:
    """List a node's own parameters; those of the model are told once, elsewhere."""
    yield from _named(kind, prefix)
    for item in fields(kind):
        if is_dataclass(item.default) and not isinstance(item.default, (Robot, Friction)):
            yield from _flat(item.default, f'{prefix}{item.name}.')


def _named(kind: Any, prefix: str) -> Iterator[tuple[str, Spec]]:
    return ((prefix + spec.name, spec) for spec in specs(kind))


def _table(rows: Iterable[tuple[str, Spec]], fixed: Iterable[str] | None = None) -> str:
    lines = ['| parameter | default | valid | meaning |', '|---|---|---|---|']
    for name, spec in rows:
        live = '' if fixed is None or name in fixed else ' *Live.*'
        lines.append(f'| `{name}` | {_shown(spec)} | {_valid(spec)} | {spec.meaning}.{live} |')
    return '\n'.join([*lines, ''])


def _shown(spec: Spec) -> str:
    value = spec.default
    if isinstance(value, tuple):
        return ', '.join(value)
    if isinstance(value, float):
        return f'{value:g} {spec.unit.removeprefix("-")}'.rstrip()
    return str(value).lower() if isinstance(value, bool) else f'{value}' or 'empty'


def _valid(spec: Spec) -> str:
    kinds = {bool: 'true, false', str: 'text', tuple: 'texts'}
    if not spec.choices and type(spec.default) in kinds:
        return kinds[type(spec.default)]
    return spec.valid


if __name__ == '__main__':
    TARGET.write_text(page(), 'utf-8')
