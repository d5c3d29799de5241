"""Simulated runs to tables for other programs: a folder of files with documented columns."""

from diffbot_sim.tables.columns import COLUMNS, columns_of
from diffbot_sim.tables.folder import check_replaceable, replacing
from diffbot_sim.tables.formats import FORMATS, writer
from diffbot_sim.tables.manifest import write_manifest

__all__ = [
    'COLUMNS',
    'FORMATS',
    'check_replaceable',
    'columns_of',
    'replacing',
    'write_manifest',
    'writer',
]
