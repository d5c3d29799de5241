"""The manifest: which runs a data set holds, of which seeds, and what the columns mean."""

import json
from collections.abc import Mapping
from pathlib import Path

from diffbot_sim import __version__
from diffbot_sim.tables.columns import description

MANIFEST = 'manifest.json'
MAKER = 'diffbot_sim'


def write_manifest(folder: Path, seed: int, runs: Mapping[str, int]) -> None:
    """Write manifest.json; runs: the seed of each file."""
    content = {
        'made_by': f'{MAKER} {__version__}',
        'seed': seed,
        'runs': [{'file': file, 'seed': own} for file, own in runs.items()],
        'columns': description(),
    }
    text = json.dumps(content, indent=1, ensure_ascii=False)
    (folder / MANIFEST).write_text(text + '\n', 'utf-8')


def has_manifest(folder: Path) -> bool:
    """Say whether a folder holds a data set that was made here."""
    try:
        content = json.loads((folder / MANIFEST).read_text('utf-8'))
    except (OSError, ValueError):
        return False
    return isinstance(content, dict) and str(content.get('made_by')).startswith(MAKER)
