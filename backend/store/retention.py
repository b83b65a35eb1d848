"""Removal of what is old: jobs without a label or a link, results that nothing shows, files that nothing names.

A run stays with its scenario and its strategies, so that it can be computed again; of its results the summaries go.

What may be removed is looked for first, then locked, then looked at again: who labels, resumes, links or uses it
meanwhile has committed that by then, or waits and finds it removed (SQLite lets one write at a time anyway).
"""

from collections.abc import Sequence
from datetime import datetime

from sqlalchemy import Connection, Select, Table, delete, exists, func, or_, select, update

from backend.db.database import RowStore
from backend.db.tables import (
    EXPIRED_RESULT,
    REMOVED,
    UNEXPIRED,
    job_roads,
    job_runs,
    jobs,
    links,
    pinned_series,
    recordings,
    results,
    roads,
    run_recordings,
    run_results,
    run_roads,
)
from backend.store.job import FINAL
from backend.store.jobs import mark_removed

REMOVED_AT_ONCE = 500  # results, roads or recordings in one transaction
JOBS_REMOVED_AT_ONCE = 20  # jobs of users, each with up to some hundred that it submitted
SIZES = (
    results.c.summary,
    pinned_series.c.content,
    job_runs.c.changes,
    jobs.c.sweep,
    roads.c.content,
    recordings.c.content,
)

Removable = Select[str, datetime]


class RetentionStore(RowStore):
    """Removes old rows; every method is one short transaction."""

    def size(self) -> int:
        """Return the size of what is stored [bytes].

        Of SQLite the file's pages in use. A table of PostgreSQL does not shrink when rows are deleted: there it is the
        size of results, pinned time histories, rows of jobs, roads and recordings, and its own overhead is extra.
        """
        with self._database.reading(large=True) as connection:
            if connection.dialect.name == "sqlite":
                pages, free, each = (
                    connection.exec_driver_sql(f"PRAGMA {name}").scalar_one()
                    for name in ("page_count", "freelist_count", "page_size")
                )
                return int((pages - free) * each)
            return sum(
                int(connection.execute(select(func.coalesce(func.sum(func.octet_length(each)), 0))).scalar_one())
                for each in SIZES
            )

    def oldest(self) -> datetime | None:
        """Return when the last row of the oldest removable page was stored; None where nothing is removable."""
        with self._database.reading() as connection:
            pages = [
                connection.execute(select(func.max(page.c.created))).scalar_one()
                for page in (_page(what).subquery() for what in REMOVABLE)
            ]
        return min((created for created in pages if created is not None), default=None)

    def remove(self, what: str, before: datetime) -> int:
        """Remove a page of what was stored, or of jobs that ended, before then; return how many.

        Jobs go with those that they submitted; `JobStore.purge` then deletes their rows. Of a result that runs have,
        the summary alone goes.

        Args:
            what: One of `REMOVABLE`.
            before: By the database's clock.
        """
        key, created = REMOVABLE[what].selected_columns
        removable = _page(what).where(created < before)
        with self._database.writing() as connection:
            found = [each for each, _ in connection.execute(removable)]
            found = _family(connection, found) if what == "jobs" else found
            _lock(connection, key.table, found)
            keys = [each for each, _ in connection.execute(removable.where(key.in_(found)))]
            if what == "jobs":
                mark_removed(connection, _family(connection, keys))
            elif what == "results":
                _remove_results(connection, keys)
            else:
                connection.execute(delete(key.table).where(key.in_(keys)))
        return len(keys)


def _lock(connection: Connection, table: Table, keys: Sequence[str]) -> None:
    """Lock these rows, in an order that every writer keeps to."""
    (key,) = table.primary_key
    connection.execute(select(key).where(key.in_(keys)).order_by(key).with_for_update())


def _family(connection: Connection, ids: Sequence[str]) -> list[str]:
    """Return the jobs and those they submitted."""
    family = select(jobs.c.id).where(or_(jobs.c.id.in_(ids), jobs.c.parent_id.in_(ids)))
    return list(connection.execute(family).scalars())


def _remove_results(connection: Connection, keys: Sequence[str]) -> None:
    in_runs = select(run_results.c.result_key).where(run_results.c.result_key.in_(keys))
    in_use = list(connection.execute(in_runs.distinct()).scalars())
    connection.execute(update(results).where(results.c.key.in_(in_use)).values(**EXPIRED_RESULT))
    connection.execute(delete(results).where(results.c.key.in_(set(keys) - set(in_use))))


def _page(what: str) -> Removable:
    limit = JOBS_REMOVED_AT_ONCE if what == "jobs" else REMOVED_AT_ONCE
    return REMOVABLE[what].order_by("created").limit(limit)


def _removable_jobs() -> Removable:
    member = jobs.alias()  # the job itself, or one that it submitted
    linked = exists().where(links.c.job_id == member.c.id)
    named = or_(member.c.label.is_not(None), member.c.state.not_in(FINAL), linked)
    family = or_(member.c.id == jobs.c.id, member.c.parent_id == jobs.c.id)
    of_users = jobs.c.parent_id.is_(None), jobs.c.state.in_(FINAL), jobs.c.kind != REMOVED
    return select(jobs.c.id, jobs.c.finished_at.label("created")).where(*of_users, ~exists().where(family, named))


def _removable_results() -> Removable:
    linked = links.c.run_id == run_results.c.run_id
    needed = (
        exists().where(job_runs.c.result_key == results.c.key),
        exists().where(pinned_series.c.result_key == results.c.key),
        exists().where(linked, run_results.c.result_key == results.c.key),
    )
    # The condition UNEXPIRED stands as the index has it.
    return select(results.c.key, results.c.created_at.label("created")).where(UNEXPIRED, *(~each for each in needed))


def _removable_files(table: Table, *uses: Table) -> Removable:
    column = f"{table.name.removesuffix('s')}_id"
    named = (exists().where(each.c[column] == table.c.id) for each in uses)
    return select(table.c.id, table.c.created_at.label("created")).where(*(~each for each in named))


# Jobs first: after that nothing needs their results or their roads.
REMOVABLE: dict[str, Removable] = {
    "jobs": _removable_jobs(),
    "results": _removable_results(),
    "roads": _removable_files(roads, run_roads, job_roads),
    "recordings": _removable_files(recordings, run_recordings),
}
