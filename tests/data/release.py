"""A database as core 0.2.0 left it when it was killed: every row, and what its service had answered before.

Such a fixture is made once, by a release's own code, and never again: it stands for the databases out there (the
history of this file has the program that made it). It has two runs (a strategy of the second failed), links to them and
to a batch, and a batch and a tuning each that are done and that are not.
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

from backend.store import Store

SCENARIO = {
    "road": {"length": 12, "seed": 9, "bump": {"height": 0.08, "width": 2, "start": 5}},
    "speed": {"initial_speed_kmh": 60, "target_speed_kmh": 50, "detection_distance": 5},
}


@cache
def content() -> Any:
    """The fixture: `revision` of the database's schema, `tables` with their rows, `answers` by path."""
    return json.loads(gzip.decompress(Path(__file__).with_name("release_0_2_0.json.gz").read_bytes()))


def restore(store: Store) -> None:
    """Put every row into an empty database, at the revision it had."""
    tables, metadata = content()["tables"], MetaData()
    store.migrate(content()["revision"])
    with store.writing() as connection:
        metadata.reflect(connection)
        for table in metadata.sorted_tables:
            if rows := tables.get(table.name):
                types = {column.name: column.type for column in table.c}
                values = [{name: _from_json(types[name], value) for name, value in row.items()} for row in rows]
                connection.execute(table.insert(), values)


def dump(connection: Connection) -> dict[str, list[dict[str, Any]]]:
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
