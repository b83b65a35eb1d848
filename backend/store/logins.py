"""Logins of the page that were ended before their time, so that no replica takes their cookies any more."""

from datetime import timedelta

from sqlalchemy import delete, select

from backend.db.clock import Now
from backend.db.database import RowStore, insert_new
from backend.db.tables import ended_logins

KEPT = timedelta(days=91)  # a login lasts 90 days


class LoginStore(RowStore):
    """Reads and writes ended logins."""

    def end(self, login: str) -> None:
        """Commit that a login has ended; those whose cookies are too old by now are forgotten."""
        with self._database.writing() as connection:
            now = connection.execute(select(Now())).scalar_one()
            connection.execute(delete(ended_logins).where(ended_logins.c.ended_at < now - KEPT))
            insert_new(connection, ended_logins, [{"login": login}])

    def has_ended(self, login: str) -> bool:
        """Whether it has."""
        with self._database.reading() as connection:
            row = connection.execute(select(ended_logins.c.login).where(ended_logins.c.login == login)).first()
        return row is not None
