"""Lists page by page, the newest first; a cursor is where the next page begins."""

from collections.abc import Sequence
from datetime import UTC, datetime, timedelta
from typing import Any

from sqlalchemy import Connection, Row, Select, Table, and_, or_

CURSOR = r"^\d{16}_[A-Za-z0-9_-]{1,22}$"  # when the last row of a page was created, and its key
EPOCH, MICROSECOND = datetime(1970, 1, 1, tzinfo=UTC), timedelta(microseconds=1)


def read_page(
    connection: Connection, table: Table, query: Select[Any], limit: int, cursor: str | None
) -> tuple[Sequence[Row[Any]], str | None]:
    """Return the newest rows of the table that the query finds, and the cursor of the next page (None: it is the last).

    Args:
        connection: Within a transaction.
        table: It has `created_at` and one key, which the query selects.
        query: It may have conditions and no order.
        limit: At most so many.
        cursor: Of the page before.
    """
    (key,), created = table.primary_key, table.c.created_at
    if cursor is not None:
        microseconds, _, last = cursor.partition("_")
        time = EPOCH + int(microseconds) * MICROSECOND
        query = query.where(or_(created < time, and_(created == time, key < last)))
    rows = connection.execute(query.order_by(created.desc(), key.desc()).limit(limit + 1)).all()
    if len(rows) <= limit:
        return rows, None
    last_shown = rows[limit - 1]
    return rows[:limit], f"{(last_shown.created_at - EPOCH) // MICROSECOND:016}_{last_shown._mapping[key.name]}"
