"""Databases as cores 0.2.0, 0.3.0 and 0.4.0 left them when they were killed: every row, and what was answered before.

Such a fixture is made once, by a release's own code, and never again: it stands for the databases out there (the
history of this file, and of make_release.py beside it, has the programs that made them). Each has runs (one with a
strategy that failed), links to them and to a batch, and a batch and a tuning each that are done and that are not. That
of 0.3.0 has jobs with an owner and a label, an unfinished job of the paper page, runs over several roads, on a measured
road, with an estimated state and with `lv_hil`, and runs whose results retention had removed.

That of 0.4.0 (899e0802) also has custom controllers, whose files are in it, recordings, pinned variants, a batch on a
measured road and a robustness study; failures that were the machine's fault; and results of a controller that sets its
preview as a plain attribute, which are those of another scenario. It is SQLite's. The same program was run with
PostgreSQL: the rows differ in their ids and times alone.
"""

import base64
import gzip
import json
from datetime import UTC, datetime
from functools import cache
from pathlib import Path
from typing import Any, Literal, get_args

from sqlalchemy import Connection, DateTime, LargeBinary, MetaData, select
from sqlalchemy.types import TypeEngine

from backend.store import Store

Version = Literal["0.2.0", "0.3.0", "0.4.0"]
VERSIONS: tuple[Version, ...] = get_args(Version)
Rows = list[dict[str, Any]]

# Of 0.2.0.
SCENARIO = {
    "road": {"length": 12, "seed": 9, "bump": {"height": 0.08, "width": 2, "start": 5}},
    "speed": {"initial_speed_kmh": 60, "target_speed_kmh": 50, "detection_distance": 5},
}

# The tables and columns of 0.2.0 that have another name now.
MOVED = {
    "batches": "jobs",
    "batch_runs": "job_runs",
    "batch_events": "job_events",
    "tunings": "jobs",
    "tuning_trials": "trials",
    "tuning_events": "job_events",
    "batch_id": "job_id",
    "tuning_id": "job_id",
    "comparison": "answer",
}


@cache
def content(version: Version) -> Any:
    """The fixture: `revision` of the database's schema, `tables` with their rows, `answers` by path.

    From 0.3.0 on also `expired`: by path the answers about runs before retention removed their results. From 0.4.0 on
    `machine_faults` and `stale`: by path answers that a later version may not repeat; and `files` of controllers.
    """
    path = Path(__file__).with_name(f"release_{version.replace('.', '_')}.json.gz")
    return json.loads(gzip.decompress(path.read_bytes()))


def rows(version: Version, table: str) -> Rows:
    """The rows that a table has today, with the columns' names of today."""
    tables: dict[str, Rows] = content(version)["tables"]
    return [
        {MOVED.get(name, name): value for name, value in row.items()}
        for old, each in tables.items()
        if MOVED.get(old, old) == table
        for row in each
    ]


def unfinished(version: Version, kind: Literal["batches", "tunings", "reproductions"]) -> dict[str, Any]:
    """The user's job of that kind that the service was killed in."""
    tables: dict[str, Rows] = content(version)["tables"]
    if version == "0.2.0":
        jobs = [row | {"parent_id": " " in (row["idempotency_key"] or "") or None} for row in tables[kind]]
    else:
        kinds = {"batches": "sweep", "tunings": "tuning", "reproductions": "reproduction"}
        jobs = [row for row in tables["jobs"] if row["kind"] == kinds[kind]]
    (job,) = (row for row in jobs if row["state"] == "running" and row["parent_id"] is None)
    return job


def restore(store: Store, version: Version) -> None:
    """Put every row into an empty database, at the revision it had."""
    store.migrate(content(version)["revision"])
    insert(store, version)


def insert(store: Store, version: Version) -> None:
    """Put every row into a database, as a replica of that version would."""
    tables, metadata = content(version)["tables"], MetaData()
    with store.writing() as connection:
        metadata.reflect(connection)
        for table in metadata.sorted_tables:
            if rows := tables.get(table.name):
                types = {column.name: column.type for column in table.c}
                values = [{name: _from_json(types[name], value) for name, value in row.items()} for row in rows]
                # A job stands behind the job that submitted it, which is not the order of an unordered table.
                connection.execute(table.insert(), sorted(values, key=lambda row: row.get("parent_id") is not None))


def write_controllers(version: Version, folder: Path) -> None:
    """Write the controller files of that service into a folder."""
    for name, text in content(version).get("files", {}).items():
        (folder / name).write_bytes(bytes_of(text))


def dump(connection: Connection) -> dict[str, Rows]:
    """Every row by table, with values that JSON has; bytes are in base64, and times in UTC."""
    metadata = MetaData()
    metadata.reflect(connection)
    return {
        table.name: [
            {name: _to_json(value) for name, value in row.items()}
            for row in connection.execute(select(table)).mappings()
        ]
        for table in metadata.sorted_tables
    }


def bytes_of(text: str) -> bytes:
    """The bytes that the fixture writes in base64."""
    return base64.b64decode(text)


def _to_json(value: Any) -> Any:
    if isinstance(value, datetime):
        return (value.astimezone(UTC) if value.tzinfo else value).replace(tzinfo=None).isoformat()
    return base64.b64encode(value).decode() if isinstance(value, bytes) else value


def _from_json(kind: TypeEngine[Any], value: Any) -> Any:
    if isinstance(kind, DateTime) and value is not None:
        return datetime.fromisoformat(value).replace(tzinfo=UTC)
    return bytes_of(value) if isinstance(kind, LargeBinary) else value
