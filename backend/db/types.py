"""Column types: JSON as text that orjson writes, and times that know they are UTC, by the database's own clock.

Times of rows are that clock's alone: those of replicas may differ, and may jump.
"""

from collections.abc import Callable
from datetime import UTC, datetime
from typing import Any

import orjson
from sqlalchemy import DateTime, Text
from sqlalchemy.ext.compiler import compiles
from sqlalchemy.sql.functions import FunctionElement
from sqlalchemy.types import TypeDecorator

from backend.errors import DamagedError


class Json(TypeDecorator[Any]):
    """JSON as text; None is no JSON but NULL."""

    impl = Text
    cache_ok = True

    def process_bind_param(self, value: Any, dialect: Any) -> str | None:
        """Python value to text."""
        return None if value is None else orjson.dumps(value).decode()

    def process_result_value(self, value: str | None, dialect: Any) -> Any:
        """Text to Python value."""
        try:
            return None if value is None else orjson.loads(value)
        except orjson.JSONDecodeError:
            raise DamagedError("row") from None


class Utc(TypeDecorator[datetime]):
    """A time in UTC: SQLite forgets the zone."""

    impl = DateTime(timezone=True)
    cache_ok = True

    def result_processor(self, dialect: Any, coltype: Any) -> Callable[[Any], datetime | None] | None:
        """Return what makes a time of a stored value, and raises DamagedError where it is none."""
        read = super().result_processor(dialect, coltype)

        def time(value: Any) -> datetime | None:
            try:
                return read(value) if read else value
            except (TypeError, ValueError):
                raise DamagedError("row") from None

        return time

    def process_result_value(self, value: datetime | None, dialect: Any) -> datetime | None:
        """Return the time with its zone."""
        if value is None:
            return None
        return value.replace(tzinfo=UTC) if value.tzinfo is None else value.astimezone(UTC)


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
