"""Share links, and the time histories they pin, by result key."""

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from typing import Any, Literal

from sqlalchemy import Connection, Row, delete, exists, or_, select, update

from backend.db.columns import UNSTORED, Now, checksum_of
from backend.db.database import RowStore, insert_new
from backend.db.tables import EXPIRED, REMOVED, jobs, links, pinned_series, results, run_results
from backend.errors import ForbiddenError, NotFoundError, RevokedError
from backend.json_types import JsonObject
from backend.store.damage import drop_damaged_pins
from backend.store.pages import read_page


@dataclass(frozen=True, slots=True, kw_only=True)
class StoredLink:
    """What a link opens: a run or a batch, and how it is looked at.

    Attributes:
        slug: Names it.
        kind: What it opens.
        target: That one's id.
        view: How it is looked at.
        owner: The token that made it; None without tokens.
        pin_of: The link whose view has this one's run pinned; None of a link that somebody asked for.
        created_at: When it was made.
        damaged_at: When something that it shows was found damaged.
    """

    slug: str
    kind: Literal["run", "batch"]
    target: str
    view: JsonObject
    owner: str | None = None
    pin_of: str | None = None
    created_at: datetime = UNSTORED
    damaged_at: datetime | None = None


class LinkStore(RowStore):
    """Reads and writes links and pins; safe for several threads and several processes."""

    def save(self, link: StoredLink, pins: Mapping[str, bytes], failed: Collection[str] = ()) -> bool:
        """Commit a link and what is not yet pinned of its time histories (by result key), together.

        False, and no change, where retention has removed the batch or a result of the run: from the commit on it
        removes nothing of either. The results with the keys `failed` are not there, as they could not be computed.
        """
        row = {name: getattr(link, name) for name in ("slug", "kind", "view", "owner", "pin_of")}
        row |= {"run_id": None, "job_id": None, "run_id" if link.kind == "run" else "job_id": link.target}
        contents: list[dict[str, object]] = [{"result_key": key, "content": content} for key, content in pins.items()]
        with self._database.writing() as connection:
            if not _lock_target(connection, link, failed):
                return False
            if contents:
                insert_new(connection, pinned_series, contents)
            connection.execute(links.insert(), [row])
        return True

    def load(self, slug: str) -> StoredLink | None:
        """Return the link of that slug, if there is one.

        Raises:
            RevokedError: It was taken back.
        """
        rows = self._checked(links, select(links).where(links.c.slug == slug), "link")
        if not rows:
            return None
        (row,) = rows
        if row.revoked_at is not None:
            raise RevokedError
        names = ("slug", "kind", "view", "owner", "pin_of", "created_at", "damaged_at")
        return StoredLink(target=row.run_id or row.job_id, **{name: row._mapping[name] for name in names})

    def page(self, owner: str | None, limit: int, cursor: str | None) -> tuple[Sequence[Row[Any]], str | None]:
        """Return the newest links; with an owner those that it made. See `read_page`."""
        columns = (links.c.slug, links.c.kind, links.c.run_id, links.c.job_id, links.c.created_at, links.c.revoked_at)
        query = select(*columns).where(links.c.pin_of.is_(None))
        if owner is not None:
            query = query.where(links.c.owner == owner)
        with self._database.reading() as connection:
            return read_page(connection, links, query, limit, cursor)

    def revoke(self, slug: str, owner: str | None) -> None:
        """Take a link back, and what it has pinned: its row stays and names nothing any more.

        Raises:
            NotFoundError: There is none.
            ForbiddenError: Another token made it, or it was made before there were tokens.
        """
        family = or_(links.c.slug == slug, links.c.pin_of == slug)
        with self._database.writing() as connection:
            rows = connection.execute(select(links).where(family).order_by(links.c.slug).with_for_update()).all()
            main = next((row for row in rows if row.slug == slug), None)
            if main is None:
                raise NotFoundError("There is no link of this slug.")
            if owner is not None and main.owner != owner:
                raise ForbiddenError("This link was not made with your token; only its owner may take it back.")
            for row in rows:
                if row.revoked_at is None:
                    empty: JsonObject = {"run_id": None, "job_id": None, "view": {}}
                    checksum = checksum_of(links, {**row._mapping, **empty})
                    revoked = update(links).where(links.c.slug == row.slug)
                    connection.execute(revoked.values(**empty, checksum=checksum, revoked_at=Now()))
            _unpin(connection, [row.run_id for row in rows])

    def pinned(self, keys: Iterable[str]) -> set[str]:
        """Return those of the results whose time histories are pinned."""
        column = pinned_series.c.result_key
        with self._database.reading() as connection:
            return set(connection.execute(select(column).where(column.in_(list(keys)))).scalars())

    def load_pins(self, keys: Iterable[str]) -> dict[str, bytes]:
        """Pinned time histories by result key, as `backend.runs.pins` wrote them, of those pinned and undamaged."""
        query = select(pinned_series)
        with self._database.reading() as connection:
            rows = connection.execute(query.where(pinned_series.c.result_key.in_(list(keys)))).all()
        damaged = drop_damaged_pins(self._database, rows)
        return {row.result_key: bytes(row.content) for row in rows if row.result_key not in damaged}


def _lock_target(connection: Connection, link: StoredLink, failed: Collection[str]) -> bool:
    """Keep retention from removing what the link shows before it is committed; False where it has removed some of it.

    A run of which there is nothing at all is left to the foreign key.
    """
    if link.kind == "batch":
        target = select(jobs.c.kind).where(jobs.c.id == link.target).with_for_update(read=True)
        return connection.execute(target).scalar() not in (None, REMOVED)
    shown = (
        select(results.c.key, results.c.status)
        .join(run_results, run_results.c.result_key == results.c.key)
        .where(run_results.c.run_id == link.target)
        .order_by(results.c.key)
        .with_for_update(read=True, of=results)
    )
    return all(status != EXPIRED or key in failed for key, status in connection.execute(shown))


def _unpin(connection: Connection, runs: Sequence[str]) -> None:
    """Remove the pinned time histories of these runs that no link shows any more."""
    of_runs = select(run_results.c.result_key).where(run_results.c.run_id.in_(runs))
    keys = select(results.c.key).where(results.c.key.in_(of_runs)).order_by(results.c.key).with_for_update()
    locked = list(connection.execute(keys).scalars())  # who links to them at this moment has done so, or waits
    pinned = pinned_series.c.result_key
    shown = exists().where(run_results.c.result_key == pinned, links.c.run_id == run_results.c.run_id)
    connection.execute(delete(pinned_series).where(pinned.in_(locked), ~shown))
