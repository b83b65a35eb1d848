"""Time histories as Parquet, in a worker; imported where the extra `parquet` is installed and asked for."""

from collections.abc import Iterable, Mapping, Sequence
from typing import IO

import numpy as np
import pyarrow as pa
from pyarrow import parquet

from backend.runs.series import SeriesArray
from sim_core.catalogue import SIGNALS

pa.set_memory_pool(pa.system_memory_pool())  # the C library's: `make_room` gives back what it keeps

Table = tuple[str, Sequence[SeriesArray]]  # a strategy and some samples of each signal


def write(
    tables: Iterable[Table],
    columns: Mapping[str, str],
    provenance: Mapping[str, str],
    file: IO[bytes],
    *,
    with_strategy: bool,
) -> None:
    """Write a file; units are field metadata, the provenance is the file's.

    Args:
        tables: What to write, in order.
        columns: Signal -> the name of its column.
        provenance: Where the samples come from.
        file: Takes it.
        with_strategy: Whether a first column names the strategy.
    """
    named = [pa.field("strategy", pa.string())] if with_strategy else []
    fields = [
        pa.field(column, pa.float32(), metadata={"signal": key, "unit": SIGNALS[key].unit})
        for key, column in columns.items()
    ]
    schema = pa.schema(named + fields, metadata={f"ridelab.{key}": value for key, value in provenance.items()})
    # Of numbers that hardly repeat dictionaries take more than they save.
    with parquet.ParquetWriter(file, schema, compression="zstd", use_dictionary=["strategy"]) as writer:
        for strategy, samples in tables:
            names = [pa.repeat(strategy, len(samples[0]))] if with_strategy else []
            writer.write_table(pa.Table.from_arrays([*names, *map(_arrow, samples)], schema=schema))


def _arrow(values: SeriesArray) -> pa.Array:
    """The same numbers; `pa.array` would import pandas, where it is installed, for 30 MB of each worker."""
    return pa.Array.from_buffers(pa.float32(), len(values), [None, pa.py_buffer(np.ascontiguousarray(values))])


def pinned_units(content: bytes) -> dict[str, str]:
    """The unit of each signal of a pin that a version until 0.3.0 wrote."""
    schema = parquet.read_schema(pa.BufferReader(content))
    return {field.name: (field.metadata or {}).get(b"unit", b"").decode() for field in schema}


def pinned_samples(content: bytes, signals: Sequence[str]) -> dict[str, SeriesArray]:
    """Those signals of such a pin."""
    table = parquet.read_table(pa.BufferReader(content), columns=list(signals))
    return {key: column.to_numpy() for key, column in zip(table.column_names, table.columns, strict=True)}
