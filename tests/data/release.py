"""The database that 899e0802 (core 0.4.0) left when it was killed: every row, and what was answered before.

Made once, by that commit's own code, and never again: it stands for the databases out there (the history of this file,
and of make_release.py beside it, has the program). It has runs (one with a strategy that failed), links to them and to
a batch, and a batch and a tuning each that are done and that are not; jobs with an owner and a label, an unfinished job
of the paper page, runs over several roads, on a measured road, with an estimated state and with `lv_hil`, and runs
whose results retention had removed; custom controllers, whose files are in it, recordings, pinned variants, a batch on
a measured road and a robustness study; failures that were the machine's fault; and results of a controller that sets
its preview as a plain attribute, which are those of another scenario.

It is SQLite's. The same program was run with PostgreSQL: the rows differ in their ids and times alone. Its schema is
that of either database, as that commit's migrations left it.
"""

import base64
import gzip
import json
from datetime import UTC, datetime
from functools import cache
from pathlib import Path
from typing import Any

from sqlalchemy import Connection, DateTime, LargeBinary, MetaData, select
from sqlalchemy.types import TypeEngine

from backend.db.sqlite import database_file
from backend.store import Store

VERSION = "0.4.0"
FOLDER = Path(__file__).parent
KINDS = {"batches": "sweep", "tunings": "tuning", "reproductions": "reproduction"}
Rows = list[dict[str, Any]]


@cache
def content() -> Any:
    """The fixture: `revision` of the database's schema, `tables` with their rows, `answers` by path.

    Also `expired`: by path the answers about runs before retention removed their results; `machine_faults` and `stale`:
    by path answers that a later version may not repeat; and `files` of controllers.
    """
    return json.loads(gzip.decompress((FOLDER / "release_0_4_0.json.gz").read_bytes()))


def rows(table: str) -> Rows:
    """The rows of a table."""
    rows: Rows = content()["tables"][table]
    return rows


def unfinished(kind: str) -> dict[str, Any]:
    """The user's job of that kind (of `KINDS`) that the service was killed in."""
    jobs = [row for row in rows("jobs") if row["kind"] == KINDS[kind]]
    (job,) = (row for row in jobs if row["state"] == "running" and row["parent_id"] is None)
    return job


def restore(store: Store) -> None:
    """Put every row into an empty database, with the schema that it had."""
    statements: list[str] = json.loads((FOLDER / "schema_0013.json").read_text())[store.engine.dialect.name]
    if (file := database_file(store.engine.url)) is not None:
        file.create()
    metadata = MetaData()
    with store.writing() as connection:
        for statement in statements:
            connection.exec_driver_sql(statement)
        metadata.reflect(connection)
        for table in metadata.sorted_tables:
            types = {column.name: column.type for column in table.c}
            values = [
                {name: _from_json(types[name], value) for name, value in row.items()}
                for row in content()["tables"].get(table.name, ())
            ]
            if values:  # a job stands behind the job that submitted it, which is not the order of an unordered table
                connection.execute(table.insert(), sorted(values, key=lambda row: row.get("parent_id") is not None))
        connection.execute(metadata.tables["alembic_version"].insert().values(version_num=content()["revision"]))


def write_controllers(folder: Path) -> None:
    """Write the controller files of that service into a folder."""
    for name, text in content()["files"].items():
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
