"""Batches as tables: a row for each run, units in the header, built page by page so that memory stays flat."""

import itertools
from collections.abc import AsyncIterator, Awaitable, Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import IO, Any

import orjson

from backend.batches import rendering
from backend.file_formats import FormatName
from backend.job_run import JobRow
from backend.json_types import JsonObject
from backend.pieces import render_to
from backend.store import StoredJob
from sim_core.catalogue import METRICS
from sim_core.scenario import dotted

Pages = AsyncIterator[list[JobRow]]
Call = Callable[..., Awaitable[Any]]  # runs a function in a worker

TABLE_VALUE_BYTES = 16  # of one value as JSON, about
FIXED = ("run", "strategy", "status", "reason", "core_version")


def units(batch: StoredJob) -> dict[str, str]:
    """Return the unit of each column that has one."""
    named = {name: dotted.fields()[name].unit for name in batch.request["fields"] if name in dotted.fields()}
    return named | {key: metric.unit for key, metric in METRICS.items()}


@dataclass(frozen=True, slots=True, kw_only=True)
class Page:
    """Some of a batch's rows: so many from that run on, or all."""

    first: int = 0
    limit: int | None = None

    def next(self, total: int) -> int | None:
        """Return the first run of the next page of a batch of so many runs; None of the last one."""
        after = total if self.limit is None else self.first + self.limit
        return after if after < total else None


async def as_json(batch: StoredJob, page: Page, pages: Pages, call: Call) -> AsyncIterator[bytes]:
    """`{"batch", …, "rows": [{"run", fields, "strategy", "status", "metrics", …}, …], "next"}`."""
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
    yield b'],"next":' + orjson.dumps(page.next(batch.total)) + b"}"


async def as_csv(batch: StoredJob, _: Page, pages: Pages, call: Call) -> AsyncIterator[bytes]:
    """A header with units, then a line for each run, as spreadsheets read it."""
    fields = batch.request["fields"]
    yield ",".join(column_names(batch).values()).encode() + b"\n"
    async for rows in pages:
        yield await call(rendering.as_csv, rows, batch.id, fields)


def column_names(batch: StoredJob) -> dict[str, str]:
    """Return the columns of a file by key, each with the name it has there: `road.length [m]`."""
    unit_of = units(batch)
    keys = (*FIXED, *batch.request["fields"], *METRICS, "source", "batch")
    return {key: f"{key} [{unit_of[key]}]" if key in unit_of else key for key in keys}


RENDERERS: Mapping[FormatName, Callable[[StoredJob, Page, Pages, Call], AsyncIterator[bytes]]] = {
    "json": as_json,
    "csv": as_csv,
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
