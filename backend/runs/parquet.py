"""Pins of versions until 0.3.0, which are Parquet; imported where the extra `parquet` is installed and one is read."""

from collections.abc import Sequence

import pyarrow as pa
from pyarrow import parquet

from backend.runs.series import SeriesArray

pa.set_memory_pool(pa.system_memory_pool())  # the C library's: `make_room` gives back what it keeps


def pinned_units(content: bytes) -> dict[str, str]:
    """Return the unit of each signal of such a pin."""
    schema = parquet.read_schema(pa.BufferReader(content))
    return {field.name: (field.metadata or {}).get(b"unit", b"").decode() for field in schema}


def pinned_samples(content: bytes, signals: Sequence[str]) -> dict[str, SeriesArray]:
    """Return those signals of such a pin."""
    table = parquet.read_table(pa.BufferReader(content), columns=list(signals))
    return {key: column.to_numpy() for key, column in zip(table.column_names, table.columns, strict=True)}
