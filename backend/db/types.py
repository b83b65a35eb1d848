"""Column types: JSON as text that orjson writes, and times that know they are UTC."""

from collections.abc import Callable
from datetime import UTC, datetime
from typing import Any

import orjson
from sqlalchemy import DateTime, Text
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
        """What makes a time of a stored value, and raises DamagedError where it is none."""
        read = super().result_processor(dialect, coltype)

        def time(value: Any) -> datetime | None:
            try:
                return read(value) if read else value
            except (TypeError, ValueError):
                raise DamagedError("row") from None

        return time

    def process_result_value(self, value: datetime | None, dialect: Any) -> datetime | None:
        """The time with its zone."""
        if value is None:
            return None
        return value.replace(tzinfo=UTC) if value.tzinfo is None else value.astimezone(UTC)
