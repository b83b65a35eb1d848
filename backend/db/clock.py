"""The database's clock. Times of rows are its alone: those of replicas may differ, and may jump."""

from datetime import UTC, datetime
from typing import Any

from sqlalchemy.ext.compiler import compiles
from sqlalchemy.sql.functions import FunctionElement

from backend.db.types import Utc

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
