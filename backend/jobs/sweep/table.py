"""Batches as tables: a row for each run, units in the header, built page by page so that memory stays flat."""

import io
from collections.abc import AsyncIterator, Callable, Iterable, Mapping, Sequence
from typing import Any, Literal

import orjson
import pyarrow as pa
from pyarrow import csv, parquet

from backend.json_types import JsonObject
from backend.store import StoredJob
from backend.store.job_runs import JobRow
from sim_core.catalogue import METRICS
from sim_core.scenario import dotted

Format = Literal["json", "csv", "parquet"]
Pages = AsyncIterator[list[JobRow]]

FIXED = ("run", "strategy", "status", "reason", "core_version")


def units(batch: StoredJob) -> dict[str, str]:
    """The unit of each column that has one."""
    named = {name: dotted.fields()[name].unit for name in batch.request["fields"] if name in dotted.fields()}
    return named | {key: metric.unit for key, metric in METRICS.items()}


def columns(rows: Sequence[JobRow], names: Iterable[str], figures: Iterable[str]) -> dict[str, list[Any]]:
    """Some rows column by column: the fixed ones, the swept fields `names`, and `figures` (keys of `METRICS`)."""
    changes = [orjson.loads(row.changes) for row in rows]
    summaries = [orjson.loads(row.summary) if row.summary is not None else {} for row in rows]
    table: dict[str, list[Any]] = {
        "run": [row.position for row in rows],
        "strategy": [row.strategy for row in rows],
        "status": [row.status for row in rows],
        "reason": [_reason(row, summary) for row, summary in zip(rows, summaries, strict=True)],
        "core_version": [row.core_version for row in rows],
    }
    table |= {name: [change.get(name) for change in changes] for name in names}
    for key in figures:
        table[key] = [METRICS[key].of(summary) for summary in summaries]
    return table


async def as_json(batch: StoredJob, pages: Pages) -> AsyncIterator[bytes]:
    """`{"batch", …, "rows": [{"run", fields, "strategy", "status", "metrics", …}, …]}`."""
    head = {
        "batch": batch.id,
        "core_version": batch.core_version,
        "scenario": batch.request["scenario"],
        "sweep": batch.sweep,
        "units": units(batch),
    }
    yield orjson.dumps(head)[:-1] + b',"rows":['
    first = True
    async for rows in pages:
        text = b",".join(map(_json_row, rows))
        yield text if first else b"," + text
        first = False
    yield b"]}"


async def as_csv(batch: StoredJob, pages: Pages) -> AsyncIterator[bytes]:
    """A header with units, then a line for each run, as spreadsheets read it."""
    schema = _schema(batch)
    options = csv.WriteOptions(include_header=True, quoting_header="none")
    yield _csv(schema.empty_table(), options)
    async for rows in pages:
        yield _csv(_page(batch, rows, schema), csv.WriteOptions(include_header=False))


async def as_parquet(batch: StoredJob, pages: Pages) -> AsyncIterator[bytes]:
    """The table as Parquet, a row group for each page; units are field metadata, the provenance is the file's."""
    schema, sink = _schema(batch), _Drain()
    writer = parquet.ParquetWriter(sink, schema, compression="zstd")
    async for rows in pages:
        writer.write_table(_page(batch, rows, schema))
        yield sink.drained()
    writer.close()
    yield sink.drained()


RENDERERS: Mapping[Format, Callable[[StoredJob, Pages], AsyncIterator[bytes]]] = {
    "json": as_json,
    "csv": as_csv,
    "parquet": as_parquet,
}


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


def _json_row(row: JobRow) -> bytes:
    head = {"run": row.position, **orjson.loads(row.changes), "strategy": row.strategy, "status": row.status}
    if row.core_version is not None:
        head |= {"core_version": row.core_version, "compute_ms": row.compute_ms}
    if row.reason is not None:
        head["reason"] = row.reason
    text = orjson.dumps(head)
    # What is stored is JSON already, {"metrics": …} or {"reason": …}: its members go in as they are.
    return text if row.summary is None else text[:-1] + b"," + row.summary.encode()[1:]


def _reason(row: JobRow, summary: JsonObject) -> str | None:
    return row.reason if row.reason is not None else summary.get("reason")


def _schema(batch: StoredJob) -> pa.Schema:
    types = {"run": pa.int64(), **{name: _field_type(name) for name in batch.request["fields"]}}
    types |= {key: pa.bool_() if metric.flag else pa.float64() for key, metric in METRICS.items()}
    unit_of = units(batch)
    fields = [
        pa.field(
            f"{name} [{unit_of[name]}]" if name in unit_of else name,
            types.get(name, pa.string()),
            metadata={"key": name, **({"unit": unit_of[name]} if name in unit_of else {})},
        )
        for name in (*FIXED, *batch.request["fields"], *METRICS, "batch")
    ]
    provenance = {
        "ridelab.batch": batch.id,
        "ridelab.core_version": batch.core_version,
        "ridelab.scenario": orjson.dumps(batch.request["scenario"]),
        "ridelab.sweep": orjson.dumps(batch.sweep),
    }
    return pa.schema(fields, metadata=provenance)


def _field_type(name: str) -> pa.DataType:
    kind = dotted.fields()[name].kind if name in dotted.fields() else None
    return {"number": pa.float64(), "integer": pa.int64(), "switch": pa.bool_()}.get(str(kind), pa.string())


def _page(batch: StoredJob, rows: Sequence[JobRow], schema: pa.Schema) -> pa.Table:
    table = columns(rows, batch.request["fields"], METRICS)
    table["batch"] = [batch.id] * len(rows)
    arrays = []
    for field, values in zip(schema, table.values(), strict=True):
        if field.type == pa.string():
            values = [item if item is None or isinstance(item, str) else orjson.dumps(item).decode() for item in values]
        arrays.append(pa.array(values, field.type))
    return pa.Table.from_arrays(arrays, schema=schema)


def _csv(table: pa.Table, options: csv.WriteOptions) -> bytes:
    sink = io.BytesIO()
    csv.write_csv(table, sink, options)
    return sink.getvalue()
