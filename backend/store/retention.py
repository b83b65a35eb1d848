"""Removal of what is old: jobs without a label or a link, results that nothing shows, files that nothing names.

A run stays with its scenario and its strategies, so that it can be computed again; of its results the summaries go.

What may be removed is looked for first, then locked, then looked at again: who labels, resumes, links or uses it
meanwhile has committed that by then, or waits and finds it removed (SQLite lets one write at a time anyway).
"""

from collections.abc import Sequence
from datetime import datetime
from typing import Any, NamedTuple

from sqlalchemy import (
    Column,
    ColumnElement,
    Connection,
    Select,
    Table,
    TextClause,
    and_,
    delete,
    exists,
    func,
    or_,
    select,
    update,
)

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

Removable = Select[str, datetime]


class Removed(NamedTuple):
    """What was removed: how many rows, and on a server how many bytes of those that `size` counts."""

    rows: int
    size: int


class RetentionStore(RowStore):
    """Removes old rows; every method is one short transaction."""

    def size(self) -> int:
        """Size of what is stored [bytes]; no row is read for it, however many there are.

        Of SQLite the file's pages in use. A table of PostgreSQL does not shrink when rows are deleted: there it is the
        size of results, pinned time histories, rows of jobs, roads and recordings, and its own overhead is extra.
        """
        columns = (
            results.c.summary,
            pinned_series.c.content,
            job_runs.c.changes,
            jobs.c.sweep,
            roads.c.content,
            recordings.c.content,
        )
        with self._database.reading(large=True) as connection:
            if connection.dialect.name == "sqlite":
                pages, free, each = (
                    connection.exec_driver_sql(f"PRAGMA {name}").scalar_one()
                    for name in ("page_count", "freelist_count", "page_size")
                )
                return int((pages - free) * each)
            sizes = [
                connection.execute(select(func.coalesce(func.sum(func.octet_length(column)), 0))).scalar_one()
                for column in columns
            ]
        return int(sum(sizes))

    def size_without(self, size: int, removed: int) -> int:
        """The size that is left; PostgreSQL would have to read every row for it, so that it is subtracted [bytes]."""
        return self.size() if self._database.engine.dialect.name == "sqlite" else size - removed

    def oldest(self) -> datetime | None:
        """When the last row of the oldest removable page was stored; None where nothing is removable."""
        with self._database.reading() as connection:
            pages = [
                connection.execute(select(func.max(page.c.created))).scalar_one()
                for page in (each(None).subquery() for each in _REMOVABLE)
            ]
        return min((created for created in pages if created is not None), default=None)

    def remove_jobs(self, before: datetime) -> Removed:
        """Remove a page of jobs that ended before then, with the jobs they submitted.

        `JobStore.purge` then deletes their rows.
        """
        removable = _removable_jobs(before)
        with self._database.writing() as connection:
            ids = _ids(connection, removable)
            _lock(connection, jobs.c.id, _family(connection, ids))
            ids = _ids(connection, removable.where(jobs.c.id.in_(ids)))
            family = _family(connection, ids)
            size = _size(connection, jobs.c.sweep, jobs.c.id, family)
            size += _size(connection, job_runs.c.changes, job_runs.c.job_id, family)
            mark_removed(connection, family)
        return Removed(len(ids), size)

    def remove_results(self, before: datetime) -> Removed:
        """Remove a page of results stored before then that no job and no link needs.

        Of a result that runs have, the summary alone is removed.
        """
        removable = _removable_results(before)
        with self._database.writing() as connection:
            keys = _ids(connection, removable)
            _lock(connection, results.c.key, keys)
            keys = _ids(connection, removable.where(results.c.key.in_(keys)))
            size = _size(connection, results.c.summary, results.c.key, keys)
            in_runs = select(run_results.c.result_key).where(run_results.c.result_key.in_(keys))
            in_use = list(connection.execute(in_runs.distinct()).scalars())
            connection.execute(update(results).where(results.c.key.in_(in_use)).values(**EXPIRED_RESULT))
            connection.execute(delete(results).where(results.c.key.in_(set(keys) - set(in_use))))
        return Removed(len(keys), size)

    def remove_roads(self, before: datetime) -> Removed:
        """Remove a page of roads stored before then that no run and no job names."""
        return self._remove_sent(roads, _removable_roads(before))

    def remove_recordings(self, before: datetime) -> Removed:
        """Remove a page of recordings stored before then that no run shows."""
        return self._remove_sent(recordings, _removable_recordings(before))

    def _remove_sent(self, table: Table, removable: Removable) -> Removed:
        """Remove these rows of what was sent as a file."""
        with self._database.writing() as connection:
            ids = _ids(connection, removable)
            _lock(connection, table.c.id, ids)
            ids = _ids(connection, removable.where(table.c.id.in_(ids)))
            size = _size(connection, table.c.content, table.c.id, ids)
            connection.execute(delete(table).where(table.c.id.in_(ids)))
        return Removed(len(ids), size)


def _ids(connection: Connection, removable: Removable) -> list[str]:
    return [key for key, _ in connection.execute(removable).all()]


def _lock(connection: Connection, column: Column[Any], ids: Sequence[str]) -> None:
    """Lock these rows, in an order that every writer keeps to."""
    connection.execute(select(column).where(column.in_(ids)).order_by(column).with_for_update())


def _size(connection: Connection, column: Column[Any], key: Column[Any], ids: Sequence[str]) -> int:
    """Of that column in these rows; 0 where `size_without` measures [bytes]."""
    if connection.dialect.name == "sqlite":
        return 0
    total = select(func.coalesce(func.sum(func.octet_length(column)), 0)).where(key.in_(ids))
    return int(connection.execute(total).scalar_one())


def _family(connection: Connection, ids: Sequence[str]) -> list[str]:
    """The jobs and those they submitted."""
    family = select(jobs.c.id).where(or_(jobs.c.id.in_(ids), jobs.c.parent_id.in_(ids)))
    return list(connection.execute(family).scalars())


def _page(
    key: Column[Any],
    created: Column[Any],
    before: datetime | None,
    *conditions: ColumnElement[bool] | TextClause,
    limit: int = REMOVED_AT_ONCE,
) -> Removable:
    """The oldest rows that meet the conditions, with their times; where one is given, those of before then."""
    query = select(key, created.label("created")).where(*conditions)
    return (query if before is None else query.where(created < before)).order_by("created").limit(limit)


def _removable_roads(before: datetime | None) -> Removable:
    named = (exists().where(each.c.road_id == roads.c.id) for each in (run_roads, job_roads))
    return _page(roads.c.id, roads.c.created_at, before, *(~each for each in named))


def _removable_recordings(before: datetime | None) -> Removable:
    shown = exists().where(run_recordings.c.recording_id == recordings.c.id)
    return _page(recordings.c.id, recordings.c.created_at, before, ~shown)


def _removable_jobs(before: datetime | None) -> Removable:
    member = jobs.alias()  # the job itself, or one that it submitted
    named = or_(
        member.c.label.is_not(None),
        member.c.state.not_in(FINAL),
        exists().where(links.c.job_id == member.c.id),
    )
    family = or_(member.c.id == jobs.c.id, member.c.parent_id == jobs.c.id)
    of_users = jobs.c.parent_id.is_(None), jobs.c.state.in_(FINAL), jobs.c.kind != REMOVED
    unnamed = ~exists().where(family, named)
    return _page(jobs.c.id, jobs.c.finished_at, before, *of_users, unnamed, limit=JOBS_REMOVED_AT_ONCE)


def _removable_results(before: datetime | None) -> Removable:
    shown = exists().where(and_(links.c.run_id == run_results.c.run_id, run_results.c.result_key == results.c.key))
    needed = (
        exists().where(job_runs.c.result_key == results.c.key),
        exists().where(pinned_series.c.result_key == results.c.key),
        shown,
    )
    # The condition UNEXPIRED stands as the index has it.
    return _page(results.c.key, results.c.created_at, before, UNEXPIRED, *(~each for each in needed))


_REMOVABLE = (_removable_jobs, _removable_results, _removable_roads, _removable_recordings)
