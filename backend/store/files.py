"""What is stored of files that were sent, by content: what roads and recordings have in common.

Equal content is one row, whoever sends it. With tokens each sender owns it, lists it and takes it back for itself; the
row goes with its last owner.
"""

from collections.abc import Mapping, Sequence
from typing import Any

from sqlalchemy import Connection, Row, Table, delete, func, select, update

from backend.db.columns import Now
from backend.db.database import Database, RowStore, insert_new
from backend.db.tables import links
from backend.errors import ConflictError, ForbiddenError, NotFoundError
from backend.store.pages import read_page


class FileStore(RowStore):
    """Reads, lists and removes files of one kind; their content never changes.

    Args:
        database: It has them.
        what: One of them, for people.
        table: Has a row for each.
        owners: Has a row for each token that sent one.
        uses: Have a row for each run or job that names one: its `run_id` or `job_id`, and the file's id.
    """

    def __init__(self, database: Database, what: str, table: Table, owners: Table, *uses: Table) -> None:
        super().__init__(database)
        self._what = what
        self._table = table
        self._owners = owners
        self._uses = uses
        self._column = f"{table.name.removesuffix('s')}_id"  # of the other tables

    def page(self, owner: str | None, limit: int, cursor: str | None) -> tuple[Sequence[Row[Any]], str | None]:
        """Return the newest ones without their content; with an owner those that it sent. See `read_page`."""
        table, owners = self._table, self._owners
        query = select(*(each for each in table.c if each.name not in ("content", "analysis", "checksum")))
        if owner is not None:
            query = query.join(owners, owners.c[self._column] == table.c.id).where(owners.c.owner == owner)
        with self._database.reading() as connection:
            return read_page(connection, table, query, limit, cursor)

    def delete(self, file_id: str, owner: str | None) -> None:
        """Take one back: it goes, unless another token sent it too.

        Args:
            file_id: Its id.
            owner: Who asks; None where the service has no tokens.

        Raises:
            NotFoundError: There is none.
            ForbiddenError: It was sent by other tokens, or before there were any.
            ConflictError: Something names it.
        """
        owned = self._owners.c[self._column] == file_id
        with self._database.writing() as connection:
            row = select(self._table.c.id).where(self._table.c.id == file_id).with_for_update()
            if connection.execute(row).first() is None:
                raise NotFoundError(f"There is no {self._what} of this id.")
            others = set(connection.execute(select(self._owners.c.owner).where(owned)).scalars())
            if owner is not None and owner not in others:
                raise ForbiddenError("This was not sent with your token; only those who sent it may take it back.")
            self._check_unused(connection, file_id)
            if owner is None or others == {owner}:
                connection.execute(delete(self._table).where(self._table.c.id == file_id))
            else:
                connection.execute(delete(self._owners).where(owned, self._owners.c.owner == owner))

    def _save(self, connection: Connection, row: Mapping[str, Any], owner: str | None) -> None:
        """Insert a row; of one that is there, restart its retention."""
        insert_new(connection, self._table, [dict(row)])
        connection.execute(update(self._table).where(self._table.c.id == row["id"]).values(created_at=Now()))
        if owner is not None:
            insert_new(connection, self._owners, [{self._column: row["id"], "owner": owner}])

    def _check_unused(self, connection: Connection, file_id: str) -> None:
        """Raise ConflictError where a run, a job, or a link to one of them names the file."""
        counts = dict.fromkeys(("run", "job", "link"), 0)
        for table in self._uses:
            user = next(each for each in (table.c.get("run_id"), table.c.get("job_id")) if each is not None)
            named = select(user).where(table.c[self._column] == file_id)
            counts[user.name.removesuffix("_id")] = _count(connection, table, table.c[self._column] == file_id)
            counts["link"] += _count(connection, links, links.c[user.name].in_(named))
        if any(counts.values()):
            said = [f"{count} {name}{'' if count == 1 else 's'}" for name, count in counts.items() if count]
            are = "names" if sum(counts.values()) == 1 else "name"
            named_by = " and ".join([", ".join(said[:-1]), said[-1]] if len(said) > 1 else said)
            raise ConflictError(f"This {self._what} stays: {named_by} {are} it.", kind="in-use")


def _count(connection: Connection, table: Table, *conditions: Any) -> int:
    return connection.execute(select(func.count()).select_from(table).where(*conditions)).scalar_one()
