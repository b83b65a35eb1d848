"""Share links, and the time histories they pin, by result key."""

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from datetime import datetime
from typing import Literal

from sqlalchemy import Connection, select

from backend.db.database import RowStore, insert_new
from backend.db.tables import EXPIRED, REMOVED, jobs, links, pinned_series, results, run_results
from backend.db.types import UNSTORED
from backend.json_types import JsonObject
from backend.store.damage import drop_damaged_pins


@dataclass(frozen=True, slots=True, kw_only=True)
class StoredLink:
    """What a link opens: a run or a batch, and how it is looked at; only `damaged_at` ever changes."""

    slug: str
    kind: Literal["run", "batch"]
    target: str
    view: JsonObject
    created_at: datetime = UNSTORED
    damaged_at: datetime | None = None


class LinkStore(RowStore):
    """Reads and writes links and pins; safe for several threads and several processes."""

    def save(self, link: StoredLink, pins: Mapping[str, bytes], failed: Collection[str] = ()) -> bool:
        """Commit a link and what is not yet pinned of its time histories (by result key), together.

        False, and no change, where retention has removed the batch or a result of the run: from the commit on it
        removes nothing of either. The results with the keys `failed` are not there, as they could not be computed.
        """
        row = {
            "slug": link.slug,
            "kind": link.kind,
            "run_id": link.target if link.kind == "run" else None,
            "job_id": link.target if link.kind == "batch" else None,
            "view": link.view,
        }
        contents: list[dict[str, object]] = [{"result_key": key, "content": content} for key, content in pins.items()]
        with self._database.writing() as connection:
            if not _lock_target(connection, link, failed):
                return False
            if contents:
                insert_new(connection, pinned_series, contents)
            connection.execute(links.insert(), [row])
        return True

    def load(self, slug: str) -> StoredLink | None:
        """The link of that slug, if there is one."""
        rows = self._checked(links, select(links).where(links.c.slug == slug), "link")
        if not rows:
            return None
        (row,) = rows
        return StoredLink(
            slug=row.slug,
            kind=row.kind,
            target=row.run_id or row.job_id,
            view=row.view,
            created_at=row.created_at,
            damaged_at=row.damaged_at,
        )

    def pinned(self, keys: Iterable[str]) -> set[str]:
        """Those of the results whose time histories are pinned."""
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
