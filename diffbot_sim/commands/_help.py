"""What the help of simulate lists: the keys of the files that it reads."""

from diffbot_sim.drives import Drive, RandomForces, Segment
from diffbot_sim.parameters import Spec, specs
from diffbot_sim.physics.effects import library


def effects_help() -> str:
    """List every effect with its parameters."""
    lines = ["effects (keys below 'effects:' in the parameter file; one that is absent is off):"]
    for name, kind in sorted(library().items()):
        lines += ['', f'  {name}: {kind.meaning}']
        lines += [f'    {_line(spec)}, neutral {_text(spec.default)}' for spec in kind.specs()]
    return '\n'.join(lines)


def drive_help() -> str:
    """List the keys of a drive file."""
    return '\n'.join(
        [
            "drive file ('--drive random' is one that holds the defaults):",
            '',
            *(f'  {_line(spec)}, default {spec.default:g}' for spec in specs(Drive)),
            '',
            '  random: forces drawn anew after random times',
            *(f'    {_line(spec)}, default {spec.default:g}' for spec in specs(RandomForces)),
            '',
            '  segments: or a list of prescribed forces; a force that is left out is 0',
            *(f'    {_line(spec)}' for spec in specs(Segment)),
        ]
    )


def _text(value: float | str) -> str:
    return value if isinstance(value, str) else f'{value:g}'


def _line(spec: Spec) -> str:
    return f'{spec.name}: {spec.meaning}; {spec.valid}'
