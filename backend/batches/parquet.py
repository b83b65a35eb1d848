"""A batch's table as Parquet; imported where the extra `parquet` is installed and asked for."""

import asyncio
import io
from collections.abc import AsyncIterator, Awaitable, Callable, Mapping, Sequence
from typing import Any

import orjson
import pyarrow as pa
from pyarrow import parquet

from backend.batches import rendering
from backend.job_run import JobRow
from backend.store import StoredJob
from sim_core.catalogue import METRICS
from sim_core.scenario import dotted


async def pieces(
    batch: StoredJob,
    names: Mapping[str, str],
    units: Mapping[str, str],
    pages: AsyncIterator[list[JobRow]],
    call: Callable[..., Awaitable[Any]],
) -> AsyncIterator[bytes]:
    """The file, a row group for each page; units are field metadata, the provenance is the file's.

    Args:
        batch: Whose rows.
        names: Of the columns by key.
        units: By key.
        pages: The rows.
        call: Runs a function in a worker.
    """
    schema, sink = _schema(batch, names, units), _Drain()
    writer = parquet.ParquetWriter(sink, schema, compression="zstd")
    async for rows in pages:
        page = await call(_as_arrow, rows, batch.id, batch.request["fields"], schema.remove_metadata())
        await asyncio.to_thread(writer.write_table, page)
        yield sink.drained()
    writer.close()
    yield sink.drained()


def _as_arrow(rows: Sequence[JobRow], batch_id: str, names: Sequence[str], schema: pa.Schema) -> pa.Table:
    """Some rows as a table of that schema; runs in a worker."""
    arrays = []
    for field, values in zip(schema, rendering.whole(rows, batch_id, names).values(), strict=True):
        if field.type == pa.string():
            values = [item if item is None or isinstance(item, str) else orjson.dumps(item).decode() for item in values]
        arrays.append(pa.array(values, field.type))
    return pa.Table.from_arrays(arrays, schema=schema)


def _schema(batch: StoredJob, names: Mapping[str, str], units: Mapping[str, str]) -> pa.Schema:
    types = {"run": pa.int64(), **{name: _field_type(name) for name in batch.request["fields"]}}
    types |= {key: pa.bool_() if metric.flag else pa.float64() for key, metric in METRICS.items()}
    fields = []
    for key, name in names.items():
        unit = {"unit": units[key]} if key in units else {}
        fields.append(pa.field(name, types.get(key, pa.string()), metadata={"key": key, **unit}))
    provenance = {
        "ridelab.batch": batch.id,
        "ridelab.core_version": batch.core_version,
        "ridelab.scenario": orjson.dumps(batch.scenario),
        "ridelab.sweep": orjson.dumps(batch.sweep),
    }
    return pa.schema(fields, metadata=provenance)


def _field_type(name: str) -> pa.DataType:
    kind = dotted.fields()[name].kind if name in dotted.fields() else None
    return {"number": pa.float64(), "integer": pa.int64(), "switch": pa.bool_()}.get(str(kind), pa.string())


class _Drain(io.RawIOBase):
    """A file that is written once from front to back and read out while it grows."""

    def __init__(self) -> None:
        self._buffer = bytearray()
        self._position = 0

    def writable(self) -> bool:
        return True

    def write(self, data: Any) -> int:
        piece = bytes(data)
        self._buffer += piece
        self._position += len(piece)
        return len(piece)

    def tell(self) -> int:
        return self._position

    def drained(self) -> bytes:
        piece, self._buffer = bytes(self._buffer), bytearray()
        return piece
