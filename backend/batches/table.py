"""Batches as tables: a row for each run, units in the header, built page by page so that memory stays flat."""

import asyncio
import io
import itertools
from collections.abc import AsyncIterator, Awaitable, Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import IO, Any, Literal

import orjson
import pyarrow as pa
from pyarrow import csv, parquet

from backend.batches import rendering
from backend.job_run import JobRow
from backend.json_types import JsonObject
from backend.pieces import render_to
from backend.store import StoredJob
from sim_core.catalogue import METRICS
from sim_core.scenario import dotted

Format = Literal["json", "csv", "parquet"]
Pages = AsyncIterator[list[JobRow]]
Call = Callable[..., Awaitable[Any]]  # runs a function in a worker

TABLE_VALUE_BYTES = 16  # of one value as JSON, about
FIXED = ("run", "strategy", "status", "reason", "core_version")


def units(batch: StoredJob) -> dict[str, str]:
    """The unit of each column that has one."""
    named = {name: dotted.fields()[name].unit for name in batch.request["fields"] if name in dotted.fields()}
    return named | {key: metric.unit for key, metric in METRICS.items()}


async def as_json(batch: StoredJob, pages: Pages, call: Call) -> AsyncIterator[bytes]:
    """`{"batch", …, "rows": [{"run", fields, "strategy", "status", "metrics", …}, …]}`."""
    head = {
        "batch": batch.id,
        "core_version": batch.core_version,
        "scenario": batch.scenario,
        "sweep": batch.sweep,
        "units": units(batch),
    }
    yield orjson.dumps(head)[:-1] + b',"rows":['
    first = True
    async for rows in pages:
        text = await call(rendering.as_json, rows)
        yield text if first else b"," + text
        first = False
    yield b"]}"


async def as_csv(batch: StoredJob, pages: Pages, call: Call) -> AsyncIterator[bytes]:
    """A header with units, then a line for each run, as spreadsheets read it."""
    schema = _schema(batch)
    options = csv.WriteOptions(include_header=True, quoting_header="none")
    yield rendering.csv_of(schema.empty_table(), options)
    async for rows in pages:
        yield await call(rendering.as_csv, rows, batch.id, batch.request["fields"], schema.remove_metadata())


async def as_parquet(batch: StoredJob, pages: Pages, call: Call) -> AsyncIterator[bytes]:
    """The table as Parquet, a row group for each page; units are field metadata, the provenance is the file's."""
    schema, sink = _schema(batch), _Drain()
    writer = parquet.ParquetWriter(sink, schema, compression="zstd")
    async for rows in pages:
        page = await call(rendering.as_arrow, rows, batch.id, batch.request["fields"], schema.remove_metadata())
        await asyncio.to_thread(writer.write_table, page)
        yield sink.drained()
    writer.close()
    yield sink.drained()


RENDERERS: Mapping[Format, Callable[[StoredJob, Pages, Call], AsyncIterator[bytes]]] = {
    "json": as_json,
    "csv": as_csv,
    "parquet": as_parquet,
}


class ColumnPages:
    """Joins pages of a table to whole columns, as JSON.

    Args:
        names: Of the columns.
        file: Holds the pages' texts until all are there; memory holds where each begins.
    """

    def __init__(self, names: Sequence[str], file: IO[bytes]) -> None:
        self._names = names
        self._file = file
        self._pages: list[list[int]] = []  # of each page where its columns end in the file

    def add(self, texts: Sequence[bytes]) -> None:
        """Add a page: of each column the next values with commas between."""
        begin = self._file.tell()
        self._file.write(b"".join(texts))
        self._pages.append(list(itertools.accumulate(map(len, texts), initial=begin)))

    def assembled(self, head: JsonObject, path: Path | None) -> bytes:
        """The members of `head`, then `columns` by name; where to, see `pieces.render_to`."""
        return render_to(partial(self._write, head), path)

    def _write(self, head: JsonObject, file: IO[bytes]) -> None:
        file.write(orjson.dumps(head)[:-1] + b',"columns":{')
        for column, name in enumerate(self._names):
            file.write((b"," if column else b"") + orjson.dumps(name) + b":[")
            for number, ends in enumerate(self._pages):
                self._file.seek(ends[column])
                file.write((b"," if number else b"") + self._file.read(ends[column + 1] - ends[column]))
            file.write(b"]")
        file.write(b"}}")


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
        "ridelab.scenario": orjson.dumps(batch.scenario),
        "ridelab.sweep": orjson.dumps(batch.sweep),
    }
    return pa.schema(fields, metadata=provenance)


def _field_type(name: str) -> pa.DataType:
    kind = dotted.fields()[name].kind if name in dotted.fields() else None
    return {"number": pa.float64(), "integer": pa.int64(), "switch": pa.bool_()}.get(str(kind), pa.string())
