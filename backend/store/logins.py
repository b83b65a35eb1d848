"""Logins of the page that were ended before their time, so that no replica takes their cookies any more."""

from sqlalchemy import select

from backend.db.database import RowStore, insert_new
from backend.db.tables import ended_logins


class LoginStore(RowStore):
    """Reads and writes ended logins."""

    def end(self, login: str) -> None:
        """Commit that a login has ended, for good: a clock that is ahead for a while takes its cookie for too old."""
        with self._database.writing() as connection:
            insert_new(connection, ended_logins, [{"login": login}])

    def has_ended(self, login: str) -> bool:
        """Check whether a login has ended."""
        with self._database.reading() as connection:
            row = connection.execute(select(ended_logins.c.login).where(ended_logins.c.login == login)).first()
        return row is not None
