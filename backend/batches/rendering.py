"""Pages of a batch's rows as columns, JSON and CSV. Runs in a worker: no web here."""

import csv
import io
from collections.abc import Iterable, Sequence
from typing import Any

import orjson

from backend.job_run import JobRow
from backend.json_types import JsonObject
from sim_core.catalogue import METRICS

ROW_COST = 0.00016  # of one row with every figure [s of one core]


def columns(rows: Sequence[JobRow], names: Iterable[str], figures: Iterable[str]) -> dict[str, list[Any]]:
    """Return some rows column by column: fixed ones, swept fields, `figures` (keys of `METRICS`), the source."""
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
    return table | {"source": [summary.get("source") for summary in summaries]}


def column_texts(rows: Sequence[JobRow], names: Iterable[str], figures: Iterable[str]) -> list[bytes]:
    """Return `columns` as JSON, of each its values with commas between."""
    return [orjson.dumps(values)[1:-1] for values in columns(rows, names, figures).values()]


def as_json(rows: Sequence[JobRow]) -> bytes:
    """Return some rows as objects of JSON with commas between."""
    return b",".join(map(_json_row, rows))


def as_csv(rows: Sequence[JobRow], batch_id: str, names: Sequence[str]) -> bytes:
    """Return some rows as lines of CSV: the fixed columns, the swept fields `names`, every metric and the batch."""
    table = [[_cell(value) for value in values] for values in whole(rows, batch_id, names).values()]
    sink = io.StringIO()
    csv.writer(sink, lineterminator="\n").writerows(zip(*table, strict=True))
    return sink.getvalue().encode()


def whole(rows: Sequence[JobRow], batch_id: str, names: Sequence[str]) -> dict[str, list[Any]]:
    """Return all columns of a file."""
    return {**columns(rows, names, METRICS), "batch": [batch_id] * len(rows)}


def _cell(value: Any) -> Any:
    """Text and numbers as they are, 5 and not 5.0; true, false and lists as in JSON, nothing as an empty cell."""
    if isinstance(value, float):
        return repr(value).removesuffix(".0")
    return orjson.dumps(value).decode() if isinstance(value, bool | list | dict) else value


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
