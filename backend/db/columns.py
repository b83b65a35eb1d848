"""Columns: JSON as text that orjson writes, times in UTC by the database's own clock, and checksums.

Times of rows are that clock's alone: those of replicas may differ, and may jump. A bit that flips in a row that never
changes is noticed when the row is read: a table says in its definition which columns its checksum covers; its insertion
computes it. A row that a version without checksums has written has `UNCHECKED` in its place and counts as intact. One
without any is damaged: of a record that a flipped bit has shortened SQLite reads the last columns as NULL.
"""

import hashlib
from collections.abc import Callable, Mapping, Sequence
from datetime import UTC, datetime
from typing import Any

import orjson
from sqlalchemy import Column, DateTime, Row, String, Table, Text
from sqlalchemy.ext.compiler import compiles
from sqlalchemy.sql.functions import FunctionElement
from sqlalchemy.types import TypeDecorator

from backend.errors import DamagedError


class Json(TypeDecorator[Any]):
    """JSON as text; None is no JSON but NULL."""

    impl = Text
    cache_ok = True

    def process_bind_param(self, value: Any, dialect: Any) -> str | None:
        """Return a Python value as text."""
        return None if value is None else orjson.dumps(value).decode()

    def process_result_value(self, value: str | None, dialect: Any) -> Any:
        """Return the Python value of a text."""
        try:
            return None if value is None else orjson.loads(value)
        except orjson.JSONDecodeError:
            raise DamagedError("row") from None


class Utc(TypeDecorator[datetime]):
    """A time in UTC: SQLite forgets the zone."""

    impl = DateTime(timezone=True)
    cache_ok = True

    def result_processor(self, dialect: Any, coltype: Any) -> Callable[[Any], datetime | None] | None:
        """Return what makes a time in UTC of a stored value, and raises DamagedError where it is none."""
        read = super().result_processor(dialect, coltype)

        def time(value: Any) -> datetime | None:
            try:
                found: datetime | None = read(value) if read else value
            except (TypeError, ValueError):
                raise DamagedError("row") from None
            if found is None:
                return None
            return found.replace(tzinfo=UTC) if found.tzinfo is None else found.astimezone(UTC)

        return time


SQLITE_FUNCTION = "ridelab_now"  # of every connection to SQLite: its own has no microseconds

UNSTORED = datetime.min.replace(tzinfo=UTC)  # when something was stored that has not been yet


class Now(FunctionElement[Any]):
    """The time at which the database comes to this row, with microseconds."""

    type = Utc()
    inherit_cache = True
    name = "now_of_database"


@compiles(Now)
def _on_server(_element: Now, _compiler: Any, **_: Any) -> str:
    return "clock_timestamp()"


@compiles(Now, "sqlite")
def _on_sqlite(_element: Now, _compiler: Any, **_: Any) -> str:
    return f"{SQLITE_FUNCTION}()"


UNCHECKED = "unchecked"
LENGTH = 16  # hexadecimal digits: 64 bits, which chance does not meet


def checksum_column(*covered: str) -> Column[str]:
    """Return a table's column `checksum` of the columns with these names, filled when a row is inserted."""
    return Column(
        "checksum",
        String(LENGTH),
        nullable=True,
        default=lambda context: checksum(covered, context.get_current_parameters()),
        info={"covered": covered},
    )


def checksum_of(table: Table, values: Mapping[str, Any]) -> str:
    """Return the checksum of a row of the table with these values."""
    return checksum(table.c.checksum.info["covered"], values)


def checksum(covered: Sequence[str], values: Mapping[str, Any]) -> str:
    """Return the checksum of the covered ones of these values, by name."""
    digest = hashlib.blake2b(digest_size=LENGTH // 2)
    for name in covered:
        value = values.get(name)
        if isinstance(value, str):
            part = value.encode()
        elif isinstance(value, bytes | memoryview):
            part = bytes(value)
        else:
            if isinstance(value, int) and not isinstance(value, bool):
                value = float(value)  # a column of floats gives 1 back as 1.0
            part = orjson.dumps(value, option=orjson.OPT_SORT_KEYS)
        digest.update(len(part).to_bytes(8, "big"))
        digest.update(part)
    return digest.hexdigest()


def is_intact(table: Table, row: Row[Any], prefix: str = "") -> bool:
    """Check whether a row of the table is as it was written.

    Args:
        table: Whose row it is.
        row: With the checksum and all columns that it covers.
        prefix: What their names in the row begin with.
    """
    covered, stored = table.c.checksum.info["covered"], row._mapping[f"{prefix}checksum"]
    values = {name: row._mapping[f"{prefix}{name}"] for name in covered}
    # SQLite keeps a type with each value: one flipped bit there makes bytes of a text.
    texts = (value for name, value in values.items() if isinstance(table.c[name].type, String))
    return all(isinstance(each, str | None) for each in texts) and stored in (UNCHECKED, checksum(covered, values))
