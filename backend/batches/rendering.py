"""Pages of a batch's rows as columns, and those as Arrow and CSV. Runs in a worker: no web here."""

import io
from collections.abc import Iterable, Sequence
from typing import Any

import orjson
import pyarrow as pa
from pyarrow import csv

from backend.job_run import JobRow
from backend.json_types import JsonObject
from sim_core.catalogue import METRICS

ROW_COST = 0.00016  # of one row with every figure [s of one core]


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


def column_texts(rows: Sequence[JobRow], names: Iterable[str], figures: Iterable[str]) -> list[bytes]:
    """`columns` as JSON, of each its values with commas between."""
    return [orjson.dumps(values)[1:-1] for values in columns(rows, names, figures).values()]


def as_json(rows: Sequence[JobRow]) -> bytes:
    """Some rows as objects of JSON with commas between."""
    return b",".join(map(_json_row, rows))


def as_arrow(rows: Sequence[JobRow], batch_id: str, names: Sequence[str], schema: pa.Schema) -> pa.Table:
    """Some rows as a table of that schema: the fixed columns, the swept fields `names`, every metric and the batch."""
    table = columns(rows, names, METRICS)
    table["batch"] = [batch_id] * len(rows)
    arrays = []
    for field, values in zip(schema, table.values(), strict=True):
        if field.type == pa.string():
            values = [item if item is None or isinstance(item, str) else orjson.dumps(item).decode() for item in values]
        arrays.append(pa.array(values, field.type))
    return pa.Table.from_arrays(arrays, schema=schema)


def as_csv(rows: Sequence[JobRow], batch_id: str, names: Sequence[str], schema: pa.Schema) -> bytes:
    """The same as lines of CSV, without a header."""
    return csv_of(as_arrow(rows, batch_id, names, schema), csv.WriteOptions(include_header=False))


def csv_of(table: pa.Table, options: csv.WriteOptions) -> bytes:
    """A table as CSV."""
    sink = io.BytesIO()
    csv.write_csv(table, sink, options)
    return sink.getvalue()


def _reason(row: JobRow, summary: JsonObject) -> str | None:
    return row.reason if row.reason is not None else summary.get("reason")


def _json_row(row: JobRow) -> bytes:
    head = {"run": row.position, **orjson.loads(row.changes), "strategy": row.strategy, "status": row.status}
    if row.core_version is not None:
        head |= {"core_version": row.core_version, "compute_ms": row.compute_ms}
    if row.reason is not None:
        head["reason"] = row.reason
    text = orjson.dumps(head)
    # What is stored is JSON already, {"metrics": …} or {"reason": …}: its members go in as they are.
    return text if row.summary is None else text[:-1] + b"," + row.summary.encode()[1:]
