"""Parquet: columns that carry their description, for pandas, Polars, DuckDB and others."""

import json
from collections.abc import Mapping
from pathlib import Path

import pyarrow
from pyarrow import parquet

from diffbot_sim.records import Array
from diffbot_sim.tables.columns import description


def write(path: Path, columns: Mapping[str, Array]) -> None:
    """Write a table; the schema's metadata `columns` holds units and meanings as JSON."""
    metadata = {'columns': json.dumps(description(), ensure_ascii=False)}
    parquet.write_table(pyarrow.table(dict(columns), metadata=metadata), path, compression='zstd')
