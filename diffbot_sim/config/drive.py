"""Drive files: what is driven where there is no bag."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from diffbot_sim.config.document import read_document, write_document
from diffbot_sim.config.parts import part_of, plain
from diffbot_sim.drives import Drive, Forces, RandomForces, Segment, SegmentForces
from diffbot_sim.errors import ConfigError
from diffbot_sim.parameters import suggestion

KEYS = ['rate', 'random', 'segments']
FORM = "A drive file holds either 'random:' or 'segments:', and 'rate:' if you like."


def load_drive(path: str | Path) -> Drive:
    """Read a drive file; raises ConfigError that tells every fault at once."""
    document = read_document(path, '--drive', FORM)
    faults = [
        f'{key}: unknown key. {suggestion(str(key), KEYS)}' for key in document if key not in KEYS
    ]
    if ('random' in document) == ('segments' in document):
        faults.append(FORM)
    drive = part_of(Drive, {key: document[key] for key in document if key == 'rate'}, '', faults)
    forces = _forces(document, faults)
    if faults:
        raise ConfigError(f'{path}: ' + '; '.join(faults))
    return replace(drive, forces=forces)


def save_drive(drive: Drive, path: str | Path, comment: str = '') -> None:
    """Write a drive file from which load_drive returns an equal drive.

    Raises ConfigError when the file cannot be written.
    """
    forces: dict[str, Any]
    if isinstance(drive.forces, RandomForces):
        forces = {'random': plain(drive.forces)}
    else:
        forces = {'segments': [plain(segment) for segment in drive.forces.segments]}
    write_document(plain(drive) | forces, path, comment)


def _forces(document: Mapping[Any, Any], faults: list[str]) -> Forces:
    if 'segments' not in document:
        return part_of(RandomForces, document.get('random'), 'random', faults)
    rows = document['segments']
    if not isinstance(rows, list):
        faults.append(
            f'segments: {rows!r} is no list of segments, as - {{until: 2.0, right: 4.0}}'
        )
        return RandomForces()
    segments = tuple(_segment(row, f'segments[{i}]', faults) for i, row in enumerate(rows))
    if not faults:
        try:
            return SegmentForces(segments)
        except ConfigError as error:
            faults.append(str(error))
    return RandomForces()


def _segment(row: Any, where: str, faults: list[str]) -> Segment:
    # A segment without an end is refused with the words for a wrong one.
    values = {'until': None, **row} if isinstance(row, Mapping) else row
    return part_of(Segment, values, where, faults)
